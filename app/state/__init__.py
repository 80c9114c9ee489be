"""What the window shows, as one immutable value: the state, its options with their bounds, undo."""
