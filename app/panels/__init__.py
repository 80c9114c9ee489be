"""The window's panels: each is given a state and returns a new one, and keeps nothing."""
