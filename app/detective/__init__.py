"""A matrix of unknown meaning: every way to read it as a camera, with its picture, best first."""
