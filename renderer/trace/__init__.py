"""The tracer (image order): for each pixel, the viewing ray, the closest object, its colour.

Importing this package is quick: numba and the compiled kernels are loaded by a Tracer's own thread.
"""

import warnings

from renderer.trace.jobs.image_job import TraceJob
from renderer.trace.jobs.tracer import Tracer

__all__ = ["TraceJob", "Tracer"]

# numba looks for settings in a file of the current folder (compiled.py passes over them), and warns
# where it cannot read it.
warnings.filterwarnings("ignore", message="A Numba config file is found", category=UserWarning)
