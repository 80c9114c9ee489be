"""Cameras as others write them down: one file a format, each reads and writes.

`read_cameras` takes any of them (formats.py has the list); `written` gives one out. The formulas of
K, R and t are renderer/intrinsics.py's. Nothing here knows of scenes' objects, renderers, windows.
"""

from renderer.camera_formats.chosen import read_chosen, without_choice
from renderer.camera_formats.formats import FORMATS, format_named, read_cameras, written
from renderer.camera_formats.given import Options
from renderer.camera_formats.posed import CameraSet, Distortion, PosedCamera, one_of

__all__ = [
    "FORMATS",
    "CameraSet",
    "Distortion",
    "Options",
    "PosedCamera",
    "format_named",
    "one_of",
    "read_cameras",
    "read_chosen",
    "without_choice",
    "written",
]
