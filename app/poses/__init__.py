"""Cameras by the hundred, as a reconstruction or a data set gives them: seen, chosen, taken."""
