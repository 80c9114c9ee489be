"""Explicit SIMD inside kernels: vectors of 16 lanes."""
