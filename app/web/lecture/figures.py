"""The live figures of those steps of a lecture that modules/figure.js can draw."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from lucida.app.images.photograph.model import path_of
from lucida.app.images.photograph.reading import decoded
from lucida.app.images.request import MIRROR_DEPTH
from lucida.app.lecture.exercises import ChoiceExercise
from lucida.app.lecture.hiding import HideExercise
from lucida.app.lecture.model import Step
from lucida.app.state.app_state import AppState
from lucida.app.state.options.outside import OutsideOptions
from lucida.app.state.options.pair import PairOptions
from lucida.app.web.scene_page import packed_scene
from lucida.renderer.files.views import view_table
from lucida.renderer.scene.model import Scene, View
from lucida.renderer.system.errors import LucidaError

from .pictures import data_uri

IMAGE = 720, 480  # an image's size in pixels if the step has none, in modules/figure.js's shape
# The parts of a figure, by view.
SHOWN = {
    "raster": ("raster",),
    "ray": ("ray",),
    "outside": ("outside",),
    "compare": ("raster", "ray", "wipe"),
    "probe": ("probe",),
}
# The only parts of the outside view that modules/outside.js draws.
DRAWN = (
    *("camera", "volume", "image", "basis", "grid", "ray", "gizmo"),
    *("target", "up", "pixels"),
)


class Figures:
    """The figures of a page, and their scenes, each packed once.

    scenes: packed, by number, each with the number of its shaders. shaders: without duplicates.
    """

    def __init__(self) -> None:
        self.scenes: list[dict[str, Any]] = []
        self.shaders: list[Any] = []
        self._numbers: dict[int, int | None] = {}  # by the scenes' ids
        self._kept: list[Scene] = []  # so that no id is used twice

    def of(self, step: Step, state: AppState) -> dict[str, Any] | None:
        """Return a step's figure as JSON; None if there is none.

        A figure that draws less than the step's pictures must have something to drag. state: the
        step's. Its field "open" is true if the step's exercise is answered in the figure.
        """
        shows = [name for view in step.views for name in SHOWN.get(view, ())]
        outside = state.options.outside
        drags = "wipe" in shows
        if "outside" in shows:
            drags = drags or outside.gizmo != "none" or outside.pixels
        is_open = isinstance(step.exercise, HideExercise) or (
            isinstance(step.exercise, ChoiceExercise)
            and any(option.camera is not None for option in step.exercise.options)
        )
        if not shows or not (is_open or drags or _is_whole(step, state)):
            return None
        number = self._number(step.scene)
        if number is None:
            return None
        mirrors = MIRROR_DEPTH if state.options.mirrors else 0
        effects = {
            "shadows": state.options.shadows,
            "mirrors": mirrors,
            "exposure": state.images.exposure_ev,
        }
        options: dict[str, Any] = {"effects": effects, "from": int(state.options.one_based)}
        if state.images.resolution is not None:
            options["size"] = state.images.resolution
            if state.marked is not None:
                options["mark"] = state.marked
        if "compare" in step.views and state.options.compare.mode == "wipe":
            options["mode"] = "wipe"
        if "outside" in step.views:
            options["outside"] = _outside(step, state)
        return {
            "scene": number,
            "camera": view_table(step.view),
            "shows": shows,
            "options": options,
            "photograph": _photograph(state),
            "open": is_open,
        }

    def _number(self, scene: Scene) -> int | None:
        """Return a scene's number; None if it is too large for a page."""
        if id(scene) not in self._numbers:
            self._kept.append(scene)
            try:
                self.scenes.append(self._shared(packed_scene(scene)))
                self._numbers[id(scene)] = len(self.scenes) - 1
            except LucidaError:  # the page always has its pictures
                self._numbers[id(scene)] = None
        return self._numbers[id(scene)]

    def _shared(self, scene: dict[str, Any]) -> dict[str, Any]:
        if scene["shaders"] not in self.shaders:
            self.shaders.append(scene["shaders"])
        return scene | {"shaders": self.shaders.index(scene["shaders"])}


def _outside(step: Step, state: AppState) -> dict[str, Any]:
    """Return the camera of a step's outside view, and the parts to draw, as JSON."""
    options = state.options.outside
    drawn: dict[str, Any] = {
        "basis": options.basis,
        "image": options.image,
        "volume": options.volume,
        "ray": options.ray,
        "handles": "pixels" if options.pixels else options.gizmo,
    }
    if isinstance(task := step.exercise, HideExercise):
        middle = task.middle(task.moved).tolist()
        drawn["object"] = {"objects": task.ids(task.moved), "place": middle, "name": task.moved}
    if options.target is not None:
        drawn |= {"target": options.target, "up": options.up}
    looking = options.camera
    return drawn if looking is None else drawn | {"camera": view_table(View(looking))}


def _photograph(state: AppState) -> dict[str, Any] | None:
    """Return the photograph over a step's images as JSON, or None."""
    options = state.options.photograph
    path = path_of(state)
    if path is None or not options.shown:
        return None
    pixels = decoded(path, IMAGE).pixels[..., :3]
    return {"src": data_uri(pixels), "opacity": options.opacity}


def is_live(view: str, shows: Sequence[str]) -> bool:
    """Return True if a figure with these shows includes a view."""
    return SHOWN.get(view, ("",))[-1] in shows


def _is_whole(step: Step, state: AppState) -> bool:
    """Return True if a figure draws all parts of a step's pictures."""
    outside, images = state.options.outside, state.images
    drawn = {name: getattr(outside, name) for name in DRAWN}
    return (
        set(step.views) <= SHOWN.keys()
        and outside == OutsideOptions(**drawn)
        and state.options.pair == PairOptions()
        and not state.options.photograph.file
        and (images.dissolved, images.channel, images.samples) == (0, "color", 1)
    )
