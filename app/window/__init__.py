"""The open window: its frames, its menus, its files, and the parts around the views."""
