"""The window's state as one immutable value: the state, its options with their bounds, undo."""
