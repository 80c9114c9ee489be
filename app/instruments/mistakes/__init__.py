"""The classic wrong lines of a pixel's ray, and what each does to the picture."""
