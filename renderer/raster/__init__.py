"""The rasterizer, on every OpenGL platform that can be had.

rasterizer.py draws; setup.py computes what the shaders need of a camera; contexts.py finds a
platform; sources.py reads shaders/; display.py turns linear light into what a screen shows.
"""

from renderer.raster.display import Display
from renderer.raster.rasterizer import Rasterizer
from renderer.raster.targets import Textures

__all__ = ["Display", "Rasterizer", "Textures"]
