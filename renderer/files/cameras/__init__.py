"""Readers and writers of other programs' cameras, one file per format.

`read_cameras` reads any of them (formats.py lists them); `written` writes one. The formulas for K,
R and t are in renderer/camera/intrinsics.py.
"""

from .formats import FORMATS, format_named, read_cameras, read_chosen, without_choice, written
from .given import Options
from .posed import CameraSet, PosedCamera, one_of

__all__ = [
    "FORMATS",
    "CameraSet",
    "Options",
    "PosedCamera",
    "format_named",
    "one_of",
    "read_cameras",
    "read_chosen",
    "without_choice",
    "written",
]
