"""What a class answers: which mistakes it makes, by step and over time."""
