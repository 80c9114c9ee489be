"""Both images, as the window takes them."""

from __future__ import annotations

from collections.abc import Sequence

from app.images.pair.actions import IMAGE, MOUSE
from app.images.pair.view import Linked, RasterView, RayView
from app.ui.instrument import Instrument
from app.ui.view import DockedView

SYNONYMS = {
    "Magnify": "zoom in enlarge",
    "Reduce": "zoom out",
    "Fit": "zoom",
    "Pixel grid and values": "raster lines numbers",
    "Values as linear light": "bytes floats",
    "Brighter": "exposure ev",
    "Darker": "exposure ev",
    "Exposure 0": "reset ev brightness",
    "Linear light without sRGB's curve": "gamma transfer",
    "Straight lines": "lens distortion grid bend curve",
    "Clear mark": "deselect unmark pixel",
    "Custom size...": "resolution width height",
    "Pixels from 1 (lecture)": "count indices index one-based",
    "Pixels from 0 (arrays)": "count indices index zero-based",
    "Raster object order": "opengl rasterizer rasterization gpu",
    "Ray image order": "tracer tracing raytracer cpu",
}


def _make(views: Sequence[DockedView]) -> list[DockedView]:
    linked = Linked()
    return [RasterView(linked), RayView(linked)]


INSTRUMENT = Instrument(_make, IMAGE, MOUSE, synonyms=SYNONYMS)
