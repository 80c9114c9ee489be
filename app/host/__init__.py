"""The contract between the window and its instruments: views, actions, docking."""
