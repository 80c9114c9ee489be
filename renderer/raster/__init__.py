"""The rasterizer, on every OpenGL platform that is available.

rasterizer.py draws; setup.py computes the shaders' camera values; prepared.py prepares a scene
without OpenGL; contexts.py finds a platform; sources.py reads shaders/; display.py turns an image's
channels into pictures for a screen; screen_pass.py has the passes over whole
images; depth_range.py finds the range for the depth's false colours.
"""

from .depth_range import DepthRange
from .display import Display, Look, Section, upload
from .prepared import Prepared, prepare
from .rasterizer import Rasterizer
from .targets import Textures

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
