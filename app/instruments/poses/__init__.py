"""Cameras by the hundred, from a reconstruction or a data set: shown, selected, taken."""
