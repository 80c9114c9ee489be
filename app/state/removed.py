"""Options and views of earlier versions. Sessions and lectures that name them can still be read.

A removed option is ignored, a removed value is replaced, and one line reports it to the user.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Removed:
    """A removed option.

    instead: what to use now, as the end of a sentence.
    default: its default value, which every old session holds. Ellipsis: a session never mentions
    this option.
    """

    instead: str
    default: Any = ...


@dataclass(frozen=True)
class Replaced:
    """A removed value of an option.

    value: what takes its place.
    was_default: True if every old session holds the old value; a session's is not reported.
    """

    value: Any
    instead: str
    was_default: bool = False


TURNED = "the inspector's fields turn and scale objects"
QUIZ = "there is no quiz of wrong lines any more; a lecture asks by exercises"

# Options by path, such as "stepper.form"; "stepper" stands for all of the stepper's options.
REMOVED: dict[str, Removed] = {
    "notation": Removed("formulas and programs have the lecture's letters", "book"),
    "stepper.form": Removed("object order goes triangle by triangle", "triangles"),
    "presets_in_perspective": Removed("presets are parallel; P switches the projection", False),
    "objects.along": Removed("handles are along the world's axes", "world"),
    "objects.dropped": Removed("a dropped model is asked about", "ask"),
    "objects.snaps": Removed("the inspector's fields take exact numbers", False),
    "stepper.order": Removed("both algorithms are always side by side", "both"),
    "costs.triangles": Removed("the cost plot shows recorded images", 10_000),
    "costs.pixels": Removed("the cost plot shows recorded images", 76_800),
    "costs.recorded": Removed("the cost plot always shows recorded images", False),
    "laboratory.table": Removed("the page Storage has the kinds' sizes", True),
    "laboratory.method": Removed("a bitmap is made by a threshold", "floyd-steinberg"),
    "laboratory.apart": Removed("the projectors' discs move with laboratory.progress", 0.0),
    "laboratory.side_px": Removed("the displays' pixels are as large as there is room", 36),
    "laboratory.zoom": Removed("laboratory.progress magnifies the page 'shapes'", 1.0),
    "laboratory.zoom_center": Removed("the page 'shapes' has one centre", [0.5, 0.5]),
    "laboratory.content": Removed("projectors and displays have pictures of their own", "image"),
    "laboratory.display": Removed("all four displays are side by side", "tube"),
    "laboratory.playing": Removed("laboratory.phase is the displays' moment", False),
    "laboratory.cycle_s": Removed("laboratory.phase is the displays' moment", 8.0),
    "laboratory.order": Removed("laboratory.progress = 3 shows NumPy's rows", "row"),
    "compare.pair": Removed(
        "both renderers are compared, and a photograph is laid over them", "raster-ray"
    ),
    "compare.flipped": Removed("a wipe has both images, on the divider's sides", False),
    "probe.section": Removed("the probe's parts are folded by their headings", "all"),
    "probe.rays": Removed("rows and columns of rays are outside.bundle's", "pixel"),
    "filming": Removed("films are made by `lucida animate`"),
    "images.lens_method": Removed("a lens's raster image is always looked up", "lookup"),
    "detective": Removed(
        "paste a matrix with Ctrl+V, which asks what it means",
        {"text": "", "pixel_origin": "center", "chosen": ""},
    ),
    "outside.see": Removed("a step says from where to look by outside.camera", []),
    "outside.parameters": Removed("a ray as half a line is outside.half_line's", False),
    "photograph.distorted": Removed(
        "the lens stays in the photograph; COLMAP's image_undistorter takes it out", None
    ),
    "photograph.lay": Removed("a photograph is laid over the images", "over"),
    "your_code.tasks": Removed("`lucida check --tasks` asks a course's own tasks", ""),
    "images.values": Removed("a pixel's colour is written as the bytes that are shown", "bytes"),
    "images.pixel_size": Removed("images.resolution sets the number of large pixels", 1),
    "images.tinted": Removed("all of a colour is shown", False),
    "images.component": Removed("all of a colour is shown", "rgb"),
    "pair.value": Removed("the laboratory's page 'function' reads an image", False),
    "outside.answers": Removed("a wrong answer is always drawn", True),
    "highlight": Removed("a step's pictures point out what it is about", []),
    "mistakes.mode": Removed(QUIZ, "laboratory"),
    "mistakes.asked": Removed(QUIZ, ""),
    "mistakes.seed": Removed(QUIZ, 1),
    "mistakes.names": Removed(QUIZ, []),
    "mistakes.answer": Removed(QUIZ, ""),
    "mistakes.revealed": Removed(QUIZ, False),
    "mistakes.score": Removed(QUIZ, [0, 0]),
    "images.lens_splitting": Removed("vertices are not moved for a lens any more", 0),
}

# Values by the option's path and the old value, such as ("language", "c").
REPLACED: dict[tuple[str, Any], Replaced] = {
    ("language", "c"): Replaced("python", "programs are in Python or Julia"),
    ("compare.mode", "signed"): Replaced("absolute", "a difference has no sign"),
    ("compare.mode", "flip"): Replaced("wipe", "the divider shows either image"),
    ("laboratory.page", "subpixels"): Replaced("displays", "an LCD's pixel has three stripes"),
    ("laboratory.page", "heights"): Replaced("function", "an image's light is read at a point"),
    ("laboratory.page", "bitmaps"): Replaced("kinds", "a bitmap is made by a threshold"),
    ("laboratory.page", "vector"): Replaced("shapes", "a drawing is shown as pixels and as shapes"),
    ("objects.handle", "turn"): Replaced("move", TURNED),
    ("objects.handle", "scale"): Replaced("move", TURNED),
    ("outside.gizmo", "distance"): Replaced(
        "none", "the camera panel's field moves the image plane"
    ),
    ("costs.against", "frames"): Replaced("triangles", "no time is measured", was_default=True),
}

# Views that a lecture's step could show.
REMOVED_VIEWS: dict[str, str] = {
    "camera": "a step shows pictures; a build moves the camera",
    "detective": "paste a matrix with Ctrl+V, which asks what it means",
}


def without_removed(
    options: dict[str, Any], is_session: bool = False
) -> tuple[dict[str, Any], list[str]]:
    """Return the options that remain, and one line for each removed option or value.

    options: a table as in a lecture or a session, one table inside it for each instrument.
    is_session: leave out the lines of options that have their default values.
    """
    lines: list[str] = []
    kept = dict(_kept(options, "", is_session, lines))
    return kept, lines


def without_removed_views(names: Iterable[str]) -> tuple[list[str], list[str]]:
    """Return the names of views that still exist, and one line for each removed one."""
    names = list(names)
    lines = [
        f"{name!r} is ignored: {REMOVED_VIEWS[name]}" for name in names if name in REMOVED_VIEWS
    ]
    return [name for name in names if name not in REMOVED_VIEWS], lines


def _kept(
    table: dict[str, Any], prefix: str, is_session: bool, lines: list[str]
) -> Iterator[tuple[str, Any]]:
    for name, value in table.items():
        path = prefix + name
        if path in REMOVED:
            removed = REMOVED[path]
            if not is_session or removed.default not in (..., value):
                lines.append(f"{path} is ignored: {removed.instead}")
        elif isinstance(value, dict) and not prefix:
            yield name, dict(_kept(value, f"{path}.", is_session, lines))
        elif isinstance(value, str) and (path, value) in REPLACED:
            replaced = REPLACED[path, value]
            if not (is_session and replaced.was_default):
                lines.append(f"{path} = {value!r} is now {replaced.value!r}: {replaced.instead}")
            yield name, replaced.value
        else:
            yield name, value
