"""The two-level bounding volume hierarchy: built binary, collapsed to 16 children per node."""
