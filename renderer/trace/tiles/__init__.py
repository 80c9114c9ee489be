"""The packet tracer: tiles of 16 x 16 viewing rays, in explicit SIMD."""
