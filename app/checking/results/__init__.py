"""The answers of a class: which mistakes it makes, and in which steps."""
