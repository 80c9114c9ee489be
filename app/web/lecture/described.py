"""Alternative texts for a step's pictures, with their numbers, for those who cannot see them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from lucida.app.images.request import MIRROR_DEPTH
from lucida.app.instruments.costs.recorded import COSTS
from lucida.app.instruments.laboratory.pages import PAGES
from lucida.app.instruments.probe.model import Probe
from lucida.app.instruments.stepper.programs import run_part
from lucida.app.lecture.model import Step
from lucida.app.state.app_state import AppState
from lucida.app.state.options.outside import STAGES
from lucida.app.ui.explaining.notation import number, text_tuple
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.editing.moving import bounds_of
from lucida.renderer.editing.outline import outline

SIZE = (320, 180)  # of images whose size the window determines
MOST_NAMED = 8  # objects
LABORATORY = {
    "function": "An image; at one of its points the spectrum of the light, schematic, and the "
    "numbers r, g and b.",
    "shapes": "A house, the sun and the word HOME, once as pixels, which are squares when they are "
    "magnified, and once as shapes, which stay sharp.",
    "projectors": "Three discs of light: red, green and blue. Where two overlap, there is yellow, "
    "cyan or magenta; where all three overlap, white.",
    "displays": "The same few pixels of a tube, a DLP projector, an LCD and an LED display. Below "
    "each, the red, green and blue light of the gray pixel over a cycle: equal amounts.",
    "raster": "An image as squares, one for each pixel, with the count of its numbers.",
    "kinds": "An image as a bitmap, in gray, in colour or in floating point.",
    "exposure": "An image stored as bytes and as floating point, and then exposed: clipped parts "
    "of the bytes stay flat, the floats show brighter details.",
    "storage": "Bars for 1024 x 1024 pixels: bitmap 128 KB, grayscale 1 MB, colour 3 MB, floating "
    "point 12 MB.",
    "array": "A canvas of 3 rows and 4 columns. The cell in row 2 and column 3 is orange; in "
    "memory, Julia has one column after another, NumPy one row after another.",
    "devices": "A pencil and a brush, an eye, a camera; and a virtual camera: an eye and a frame.",
    "dimension": "Points along one line through the eye slide into one pixel of a frame.",
    "ruler": "A row of 10 pixels with rulers: for j = 7, j - 0.5 is 6.5, divided by W 0.65, minus "
    "0.5 0.15, which is u; the same downwards for i = 3, where v is 0.25.",
}
LINES = (
    "no pixel is done", "the marked pixel's ray is generated", "its closest object is found",
    "the marked pixel has its colour", "all pixels are done",
)  # fmt: skip
QUESTIONS = "a magnified image", "an eye with a frame before a ball", "a ray through the frame"
TITLES = {
    "raster": "Raster image",
    "ray": "Ray image",
    "outside": "Outside view",
    "compare": "Raster against ray image",
    "stepper": "Loops",
    "costs": "Costs",
    "laboratory": "Image laboratory",
    "your-code": "Your code",
}


def title_of(view: str) -> str:
    """Return a view's name as a caption."""
    return TITLES.get(view, view.capitalize())


def alternative(view: str, step: Step, state: AppState) -> str:
    """Return the alternative text of a view's picture. state: the step's."""
    tell = TOLD.get(view)
    return f"{title_of(view)}. {tell(step, state) if tell else _seen(step, state)}"


def _seen(step: Step, state: AppState) -> str:
    """Return the scene, the camera and the marked pixel's ray."""
    options = state.images
    size = options.resolution or SIZE
    camera = state.view.for_size(size)
    told = [_scene(step), _camera(camera), _in_image(step, camera, size)]
    if options.resolution is not None:
        told.append(f"{size[0]} x {size[1]} pixels.")
    if options.channel != "color":
        told.append(f"Its channel {options.channel}.")
    effects = [name for name in ("shadows", "mirrors") if getattr(state.options, name)]
    if effects:
        told.append(f"With {' and '.join(effects)}.")
    told += _overlays(state)
    if state.marked is not None:
        told.append(_pixel(state, size))
    return " ".join(filter(None, told))


def _overlays(state: AppState) -> list[str]:
    """Return descriptions of the drawings over the images."""
    pair = state.options.pair
    drawn = {
        f"{len(pair.parallels)} parallel lines along {text_tuple(pair.along)} are drawn to where "
        "they meet.": pair.vanishing,
        "A grid of straight lines around the eye is drawn over it.": pair.straight_lines,
        f"An inset shows the marked pixel's square; its colour is the mean of "
        f"{state.images.samples} samples in the ray image.": pair.footprint,
        "A photograph lies over it.": bool(state.options.photograph.file),
    }
    return [text for text, is_drawn in drawn.items() if is_drawn]


def _in_image(step: Step, camera: Camera, size: Size) -> str:
    """Return the objects whose middles are in the image, from left to right."""
    width, height = size
    found = []
    for row in outline(step.scene):
        if row.item is None or row.is_light or row.hidden:
            continue
        bounds = bounds_of(step.scene, [row.item])
        if bounds is None:
            continue
        seen = camera.project(bounds.mean(axis=0), size)
        if 0 <= seen.row < height and 0 <= seen.column < width:
            found.append((float(seen.column), row.shown))
    names = [name for _, name in sorted(found)]
    return f"In its image, from left to right: {_listed(names)}." if len(names) > 1 else ""


def _listed(names: Sequence[str]) -> str:
    more = len(names) - MOST_NAMED
    return "; ".join(names[:MOST_NAMED]) + (f"; and {more} more" if more > 0 else "")


def _scene(step: Step) -> str:
    names = [row.shown for row in outline(step.scene) if not (row.is_light or row.hidden)]
    return f"The scene has {_listed(names)}." if names else "The scene is empty."


def _camera(camera: Camera) -> str:
    left, right, bottom, top = camera.viewport
    told = (
        f"The camera is {camera.projection}, eye {text_tuple(camera.eye)}, looking along "
        f"{text_tuple(-one for one in camera.w)}; the viewport reaches from u = {number(left)} to "
        f"{number(right)} and from v = {number(bottom)} to {number(top)}"
    )
    told += "" if camera.is_parallel else f", at distance d = {number(camera.distance)}"
    return f"{told}." + (f" Lens: {camera.lens}." if camera.lens is not None else "")


def _pixel(state: AppState, size: Size) -> str:
    assert state.marked is not None
    row, column = state.marked
    if row >= size[1] or column >= size[0]:
        return ""
    shadows, depth = state.options.shadows, MIRROR_DEPTH if state.options.mirrors else 0
    camera = state.view.for_size(size)
    found = Probe(state.scene).at(state.marked, camera, size, shadows=shadows, mirror_depth=depth)
    where = f"Pixel {state.options.indexing.text(state.marked)} is marked"
    if found.is_outside:
        return f"{where}; the lens sees nothing there."
    ray = f"p = {text_tuple(found.origin)} and d = {text_tuple(found.direction)}"
    red, green, blue = found.bytes
    if found.hit is None:
        end = "hits nothing"
    else:
        name = next(one.name for one in found.meetings if one.object == found.hit.object)
        end = f"first hits {name} at t = {number(found.hit.t)}"
    return f"{where}: its ray has {ray}, and {end}; the colour is ({red}, {green}, {blue}) of 255."


def _outside(step: Step, state: AppState) -> str:
    options, steps = state.options.outside, state.options.stepper.parts[1]
    is_traced = "stepper" in step.views
    parts = {
        "the basis u, v, w": options.basis and options.basis_grown > 0,
        "the image plane": options.image,
        "the view volume": options.volume,
        "the marked pixel's ray": (options.ray and state.marked is not None and not is_traced)
        or (is_traced and steps > 0),
        f"{options.bundle[0]} x {options.bundle[1]} viewing rays": all(options.bundle),
        "p": options.half_line > 0,
        "d": options.half_line > 1,
        "t = 1, 2, 3": options.half_line > 2,
        "all t at which it meets objects": options.meetings > 0,
        f"the rays of {len(options.points)} points": bool(options.points)
        and options.points_grown > 0,
        f"the target {text_tuple(options.target or (0,))}": options.target is not None,
        f"{options.formula or 0:g} of {len(STAGES)} terms of the ray's formula": bool(
            options.formula
        ),
        _pixels(state): options.pixels and not state.camera.is_parallel,
    }
    drawn = ", ".join(name for name, is_drawn in parts.items() if is_drawn)
    return f"The camera seen from outside, with {drawn or 'its eye'}. {_seen(step, state)}"


def _pixels(state: AppState) -> str:
    """Return the image plane as pixels, with the numbers of K."""
    size = state.images.resolution or SIZE
    camera = state.view.for_size(size)
    if camera.is_parallel:
        return ""
    K = camera.intrinsics(size, state.options.pixel_origin).K
    focal, point = number(K[0, 0]), text_tuple((K[0, 2], K[1, 2]))
    return f"the plane's {size[0]} x {size[1]} pixels, with f = {focal} and c = {point}"


def _compared(step: Step, state: AppState) -> str:
    mode = state.options.compare.mode
    told = "left of a line the raster image, right of it the ray image" if mode == "wipe" else mode
    return f"Both images at once: {told}. {_seen(step, state)}"


def _stepper(step: Step, state: AppState) -> str:
    options = state.options.stepper
    width, height = options.canvas
    first, second = (f"{run_part(part):.0%}" for part in options.parts)
    done = LINES[min(math.ceil(options.parts[1]), len(LINES) - 1)]
    told = {
        "loops": "Two loops in words, object order and image order, and the images that they "
        f"fill; these are done to {first} and {second}",
        "rays": f"Ray tracing in three lines, and the image that it fills; {done}",
        "program": f"The whole program, and the image that it fills; it is done to {second}",
        "questions": "Small pictures: " + ", ".join(QUESTIONS[: math.ceil(options.parts[0])]),
    }[options.picture]
    return f"{told}. {width} x {height} pixels. {_scene(step)}"


def _costs(step: Step, state: AppState) -> str:
    unit = state.options.costs.against
    costs = "; ".join(
        f"{getattr(cost, unit):,} {unit}: {cost.triangles:,} triangles set up, {cost.tested:,} "
        f"pixels tested, {cost.nodes:,} nodes visited"
        for cost in COSTS[unit]
    )
    return f"A chart of counted steps, with logarithmic axes. {costs}."


def _laboratory(step: Step, state: AppState) -> str:
    options = state.options.laboratory
    told, is_scene = LABORATORY[options.page], PAGES[options.page].has_image
    stops = f" Exposed by {options.after_ev:g} stops after storage." if options.after_ev else ""
    return f"{told}{stops} {_scene(step)}" if is_scene else told


def _mistakes(step: Step, state: AppState) -> str:
    options = state.options.mistakes
    wrong = ", ".join(options.chosen) or "none"
    return (
        "The lines from a pixel to its ray, and the pictures that they make, correct and as "
        f"written. Wrong lines: {wrong}. {_seen(step, state)}"
    )


TOLD: dict[str, Callable[[Step, AppState], str]] = {
    "outside": _outside,
    "compare": _compared,
    "stepper": _stepper,
    "costs": _costs,
    "laboratory": _laboratory,
    "mistakes": _mistakes,
}
