"""A student's own file on the window's camera: its picture next to the correct one."""
