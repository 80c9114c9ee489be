"""The window while it is open: its frames, its menus, its files, what stands around the views."""
