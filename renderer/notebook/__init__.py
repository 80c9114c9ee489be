"""Frames, cameras and scenes in a notebook: pictures and tables in place of arrays."""
