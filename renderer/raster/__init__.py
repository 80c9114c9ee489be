"""The rasterizer, on every OpenGL platform that can be had.

rasterizer.py draws; setup.py computes what the shaders need of a camera; prepared.py does what of
a scene needs no OpenGL; contexts.py finds a platform; sources.py reads shaders/; display.py turns
an image's channels into what a screen shows, depth_range.py finds what false colours of the depth
range over.
"""

from renderer.raster.depth_range import DepthRange
from renderer.raster.display import Display, Look, Section, upload
from renderer.raster.prepared import Prepared, prepare
from renderer.raster.rasterizer import Rasterizer
from renderer.raster.targets import Textures

__all__ = [
    "DepthRange",
    "Display",
    "Look",
    "Prepared",
    "Rasterizer",
    "Section",
    "Textures",
    "prepare",
    "upload",
]
