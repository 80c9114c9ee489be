"""Compile the tracer's kernels and keep their machine code."""
