"""Everything below the window, usable from notebooks and tests. `lucida` has its public names."""
