"""One plain ray after another, in float64: the lecture's pseudocode, and the reference."""
