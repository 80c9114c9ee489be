"""Comparing: both images in one place, as a difference, a wipe or a flip; and where they differ."""
