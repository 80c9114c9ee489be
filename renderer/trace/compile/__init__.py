"""How kernels are compiled and kept: what touches numba's inside, beside simd/ and threads/."""
