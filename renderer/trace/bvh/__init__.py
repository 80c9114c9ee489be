"""The bounding volume hierarchy: built binary, collapsed to 16 children a node, in two levels."""
