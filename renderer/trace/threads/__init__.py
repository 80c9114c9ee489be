"""The threads that run a kernel together, and the division of work between them."""
