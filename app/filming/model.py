"""The path of a film: its key cameras, the cameras of a preview, and both as a drawing.

Pure.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from app.filming.options import FilmingOptions
from app.films.frames import Look
from app.films.paths import Key, Kind, Timing, Way
from app.images.request import MIRROR_DEPTH
from app.outside.diagram import Dot, Item, Label, Segments, polyline
from app.outside.second_camera import SecondCamera, second_camera
from app.state.options import Bookmark
from renderer.camera import Camera, Size
from renderer.errors import LucidaError
from renderer.focus import scene_focus
from renderer.scene.model import Scene, View

Floats = NDArray[np.float64]

PREVIEWED = 300  # frames at most
NUMBERED = 30  # keys at most
FAR = 3.0  # times as far from the focus as the first eye
GHOST = 0.35  # the length of its rays, of the way from the eye to the focus
PATHS = {
    "orbit": ("Orbit", "Once around the scene's middle, from this view."),
    "dolly-zoom": ("Dolly zoom", "Back, with a longer lens: the subject keeps its size."),
    "to-parallel": ("To parallel", "From this view to the parallel one that shows the same."),
    "bookmarks": ("Bookmarks", "Through the bookmarks, in the order of their numbers."),
    "file": ("Key file", "Through the key cameras of a file."),
    "photographs": ("Photographs", "Through the cameras of the open set."),
}  # fmt: skip


def bookmark_keys(marks: Sequence[Bookmark], timing: Timing) -> tuple[Key, ...]:
    """Return the bookmarks' views as keys. Raises LucidaError if they are too few."""
    if len(marks) < 2:
        problem = f"{len(marks) or 'no'} view{'s' if len(marks) != 1 else ''} kept so far"
        raise LucidaError("", problem, "Ctrl+1 to Ctrl+9 keep views as bookmarks; keep two or more")
    return tuple(Key(mark.view, 1.0, timing) for mark in marks)


def way_of(options: FilmingOptions, view: View, keys: tuple[Key, ...]) -> Way:
    """Return the camera's way. keys: for the paths that have some."""
    kinds: dict[str, Kind] = {
        "orbit": "orbit", "dolly-zoom": "dolly-zoom", "to-parallel": "to-parallel"
    }  # fmt: skip
    return Way(kinds.get(options.path, "keys"), view, keys)


def look_of(options: FilmingOptions, exposure: float, enlargement: int) -> Look:
    """Return the look of the film's frames."""
    has_effects = options.renderer != "raster"
    return Look(
        options.renderer,
        options.samples,
        has_effects and options.shadows,
        MIRROR_DEPTH if has_effects and options.mirrors else 0,
        exposure,
        enlargement=enlargement,
    )


def previewed(way: Way, scene: Scene, size: Size, count: int) -> tuple[Camera, ...]:
    """Return cameras along the way: those of all frames, or as many as a preview needs. Raises
    LucidaError.
    """
    if way.kind in ("dolly-zoom", "to-parallel") and way.view.camera.is_parallel:
        raise LucidaError("", "needs a perspective camera", "choose one, or another path")
    return tuple(way.cameras(scene_focus(scene), size, min(count, PREVIEWED)))


def drawn_path(
    cameras: tuple[Camera, ...], number: int, keys: tuple[Key, ...], size: Size, scene: Scene
) -> tuple[Item, ...]:
    """Return the way of the eye, the key cameras' eyes, and the camera of one frame."""
    if not cameras:
        return ()
    eyes = np.array([camera.eye for camera in cameras])
    items: list[Item] = [Segments("film path", "mark", polyline(eyes), 2.2, layer=2)]
    for place, key in enumerate(keys, 1):
        eye = np.asarray(key.view.camera.eye)
        items.append(Dot(f"film key {place}", "mark", eye, 5.0))
        if len(keys) <= NUMBERED:
            items.append(Label(f"film key {place}", "mark", str(place), eye))
    ghost = cameras[number]
    corners = ghost.ray([0, 0, size[1] - 1, size[1] - 1], [0, size[0] - 1, size[0] - 1, 0], size)
    center = np.asarray(scene_focus(scene).center)
    reach = GHOST * float(np.linalg.norm(center - ghost.eye))
    return (*items, *second_camera(SecondCamera(*corners), reach))


def in_sight(cameras: tuple[Camera, ...], scene: Scene) -> Floats:
    """Return the eyes (n, 3) that the outside view must show: not those that go far away."""
    eyes = np.array([camera.eye for camera in cameras]).reshape(-1, 3)
    away = np.linalg.norm(eyes - scene_focus(scene).center, axis=1)
    return eyes[away <= FAR * away[:1]]


def left_text(part: float, first: float, time_s: float) -> str:
    """Return how much is done, and the time left. first: what was done at the beginning."""
    text = f"{100 * part:.0f} %"
    if part <= first or time_s < 1:
        return text
    left_s = time_s * (1 - part) / (part - first)
    return f"{text}, {_time(left_s)} left"


def _time(time_s: float) -> str:
    if time_s < 60:
        return f"{time_s:.0f} s"
    minutes = round(time_s / 60)
    return f"{minutes} min" if minutes < 100 else f"{minutes / 60:.0f} h"
