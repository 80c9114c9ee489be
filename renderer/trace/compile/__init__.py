"""Compilation of the tracer's kernels, and the cache of their machine code."""
