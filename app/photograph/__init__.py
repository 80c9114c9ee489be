"""A photograph under or over both images, to hold a camera against what a real one has seen."""
