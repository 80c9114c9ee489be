"""Films: a camera's path, its frames, the file that holds them."""
