"""The tracer (image order): for each pixel, the viewing ray, the closest object, its colour.

Importing this package is quick: numba and the compiled kernels are loaded by a Tracer's own thread.
"""

from .image_job import TraceJob
from .tracer import Tracer

__all__ = ["TraceJob", "Tracer"]
