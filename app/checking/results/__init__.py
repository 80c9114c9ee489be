"""The answers of a class: which mistakes it makes, by step and over time."""
