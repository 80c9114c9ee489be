"""Options and views of earlier versions. Sessions and lectures that name them can still be read.

A removed option is ignored, a removed value is replaced, and one line reports it to the user.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

# The replacement, as the end of a sentence. Options are named by path, such as "stepper.form";
# "stepper" includes all of the stepper's options.
REMOVED: dict[str, str] = {
    "notation": "formulas and programs have the lecture's letters",
    "stepper.form": "object order proceeds triangle by triangle",
    "presets_in_perspective": "presets are parallel; P switches the projection",
    "objects.along": "handles are along the world's axes",
    "objects.dropped": "Lucida asks about a dropped model",
    "objects.snaps": "the inspector's fields take exact numbers",
    "stepper.order": "both algorithms are always side by side",
    **dict.fromkeys(("costs.triangles", "costs.pixels"), "the cost plot shows recorded images"),
    "costs.recorded": "the cost plot always shows recorded images",
    "laboratory.table": "the page Storage lists the kinds' sizes",
    "laboratory.method": "a bitmap is made by a threshold",
    "laboratory.apart": "the projectors' discs move with laboratory.progress",
    "laboratory.side_px": "the displays' pixels fill the view",
    "laboratory.zoom": "laboratory.progress magnifies the page 'shapes'",
    "laboratory.zoom_center": "the page 'shapes' has one centre",
    "laboratory.content": "projectors and displays have pictures of their own",
    "laboratory.display": "all four displays are side by side",
    **dict.fromkeys(
        ("laboratory.playing", "laboratory.cycle_s"), "laboratory.phase is the displays' moment"
    ),
    "laboratory.order": "laboratory.progress = 3 shows NumPy's rows",
    "compare.pair": "both renderers are compared, and a photograph is laid over them",
    "compare.flipped": "a wipe shows one image on each side of the divider",
    "probe.section": "the probe's parts are folded by their headings",
    "probe.rays": "outside.bundle sets rows and columns of rays",
    "filming": "films are made by `lucida animate`",
    "images.lens_method": "a lens's raster image is always looked up",
    "detective": "paste a matrix with Ctrl+V, which asks what it means",
    "outside.see": "a step sets the viewpoint with outside.camera",
    "outside.parameters": "outside.half_line shows a ray as half a line",
    "photograph.distorted": "the lens stays; COLMAP's image_undistorter removes it",
    "photograph.lay": "a photograph is laid over the images",
    "your_code.tasks": "`lucida check --tasks` checks a course's own tasks",
    "your_code.task": "the view shows viewing_ray; `lucida check` tries other tasks",
    "images.values": "a pixel's colour is written as the bytes that are shown",
    "images.pixel_size": "images.resolution sets the number of large pixels",
    **dict.fromkeys(("images.tinted", "images.component"), "all channels are shown"),
    "pair.value": "the laboratory's page 'function' reads an image",
    "outside.answers": "a wrong answer is always drawn",
    "highlight": "a step's pictures highlight its subject",
    **dict.fromkeys(
        (
            "mistakes.mode",
            "mistakes.asked",
            "mistakes.seed",
            "mistakes.names",
            "mistakes.answer",
            "mistakes.revealed",
            "mistakes.score",
        ),
        "the quiz of wrong lines was removed; a lecture has exercises",
    ),
    "poses.length": "the frusta have a length that suits the set",
    "images.lens_splitting": "a lens no longer moves vertices",
    "stepper.depth": "an image's channel z shows the distances",
    "stepper.speed": "holding Right steps on line by line; the slider goes to any step",
}

# The new value and its reason, by the option's path and the old value, such as ("language", "c").
REPLACED: dict[tuple[str, str], tuple[str, str]] = {
    ("preferences.theme", "contrast"): ("dark", "F9 makes its colours stronger"),
    ("language", "c"): ("python", "programs are in Python or Julia"),
    ("compare.mode", "signed"): ("absolute", "a difference has no sign"),
    ("compare.mode", "flip"): ("wipe", "the divider shows either image"),
    ("laboratory.page", "subpixels"): ("displays", "an LCD's pixel has three stripes"),
    ("laboratory.page", "heights"): ("function", "an image's light is read at a point"),
    ("laboratory.page", "bitmaps"): ("kinds", "a bitmap is made by a threshold"),
    ("laboratory.page", "vector"): ("shapes", "a drawing is shown as pixels and as shapes"),
    ("objects.handle", "turn"): ("move", "the inspector's fields turn and scale objects"),
    ("objects.handle", "scale"): ("move", "the inspector's fields turn and scale objects"),
    ("outside.gizmo", "distance"): ("none", "the camera panel has a field for d"),
    ("costs.against", "frames"): ("triangles", "no time is measured"),
}

# Views that a lecture's step could show.
REMOVED_VIEWS: dict[str, str] = {
    "camera": "a step shows pictures; a build moves the camera",
    "detective": "paste a matrix with Ctrl+V, which asks what it means",
}


def without_removed(options: dict[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """Return the options that remain, and one line for each removed option or value.

    options: a table as in a lecture or a session, one table inside it for each instrument.
    """
    lines: list[str] = []
    return dict(_kept(options, "", lines)), lines


def without_removed_views(names: Iterable[str]) -> tuple[list[str], list[str]]:
    """Return the names of views that still exist, and one line for each removed one."""
    names = list(names)
    lines = [
        f"{name!r} is ignored: {REMOVED_VIEWS[name]}" for name in names if name in REMOVED_VIEWS
    ]
    return [name for name in names if name not in REMOVED_VIEWS], lines


def _kept(table: dict[str, Any], prefix: str, lines: list[str]) -> Iterator[tuple[str, Any]]:
    for name, value in table.items():
        path = prefix + name
        if path in REMOVED:
            lines.append(f"{path} is ignored: {REMOVED[path]}")
        elif isinstance(value, dict) and not prefix:
            yield name, dict(_kept(value, f"{path}.", lines))
        elif isinstance(value, str) and (path, value) in REPLACED:
            new, instead = REPLACED[path, value]
            lines.append(f"{path} = {value!r} is now {new!r}: {instead}")
            yield name, new
        else:
            yield name, value
