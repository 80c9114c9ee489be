"""The classic wrong lines of a pixel's ray: what each does to the picture, and a quiz on them."""
