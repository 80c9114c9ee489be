"""What a student's own file makes of the window's camera: its picture beside the right one."""
