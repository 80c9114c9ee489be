"""The compare view without a window: words, units, steps from pixel to pixel.

Includes the causes' names for users, and the changes of the state for the view, the menus and the
keys.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lucida.app.state.app_state import AppState
from lucida.app.state.options.compare import CompareMode
from lucida.app.state.options.shared import Channel, ImageOptions, Pixel
from lucida.renderer.compare.raster_and_ray import AGREE, CAUSES, SHADING, UNEXPLAINED, Comparison
from lucida.renderer.images.difference import FULL_SCALE, signed_difference

MODES: tuple[tuple[CompareMode, str, str], ...] = (
    ("absolute", "Absolute", "How much the two images differ: black is no difference."),
    (
        "signed",
        "Signed",
        "How much, and which one has more: blue the raster image, orange the ray image.",
    ),
    ("wipe", "Wipe", "The raster image left of the divider, the ray image right of it."),
    ("flip", "Flip", "One image in the other's place: hold X to see the other one."),
)
MARKED_MAGNIFICATION = 32.0  # from here on the pixels show their values
STEP_FROM = 8.0  # less, and a pixel is not to be seen: then the step magnifies
DIVIDER_STEP = 0.02


@dataclass(frozen=True)
class Cause:
    """A cause of a difference. label: in Comparison.labels. name: short. told: a sentence."""

    label: int
    name: str
    told: str


LABELS = (
    Cause(1, "edge", "Within 1/128 pixel is an edge, or a line where two surfaces meet."),
    Cause(2, "pattern", "Within 1/128 pixel, a checker, a hole or a texture changes as much."),
    Cause(3, "clip", "Near or far cuts a surface there, or it is too near the eye for OpenGL."),
    Cause(4, "lookup", "The texel that the pixel looked up sees past an edge, up to half a texel."),
    Cause(SHADING, "shading", "Both see the same point, but in another colour."),
    Cause(UNEXPLAINED, "unexplained", "Nothing in the image explains it: a renderer is wrong."),
)
assert len(LABELS) == len(CAUSES) + 2


def offered(state: AppState) -> tuple[Cause, ...]:
    """Return the causes that the images of this state may have."""
    has_lens = state.camera.lens is not None
    return tuple(cause for cause in LABELS if has_lens or cause.name != "lookup")


def counts(comparison: Comparison) -> dict[int, int]:
    """Return the number of pixels for each of LABELS, by label."""
    found = {1 + k: comparison.explained[name] for k, name in enumerate(CAUSES)}
    found[SHADING] = comparison.shading
    found[UNEXPLAINED] = comparison.unexplained - comparison.shading
    return found


def headline(comparison: Comparison, effects: str = "") -> tuple[str, bool]:
    """Return the result in one line, and True if it is good news. effects: see effects_of()."""
    differing = comparison.pixels - comparison.agree
    if effects and not comparison.nothing_hit:
        return f"Not comparable with {effects}: {differing} of {comparison.pixels} differ", False
    if comparison.nothing_hit and not comparison.unexplained:
        return f"Nothing is hit in either image: {comparison.nothing_hit}", False
    if not differing:
        return "All pixels agree", True
    if not comparison.unexplained:
        causes = [label.name for label in LABELS if counts(comparison)[label.label]]
        return f"Agree but for {_pixels(differing)}: {_listed(causes)}", True
    return f"Disagree: {_pixels(comparison.unexplained)} without an explanation", False


def effects_of(state: AppState) -> str:
    """Return what only the ray image shows; empty for nothing."""
    on = [name for name in ("shadows", "mirrors") if getattr(state.options, name)]
    return " and ".join(on)


@dataclass(frozen=True)
class ColorScale:
    """The texts at a colour bar.

    title: the quantity. low, middle, high: at its ends; absolute scales begin with middle. short:
    low and high for narrow bars.
    """

    title: str
    low: str
    middle: str
    high: str
    short: tuple[str, str]


def scale(channel: Channel, gain: float, signed: bool) -> ColorScale:
    """Return the meaning of a difference's colours."""
    full = FULL_SCALE[channel] / gain
    if channel == "id":
        return ColorScale("object", "", "the same", "another one", ("", "another"))
    what, number, longer = {
        "color": ("colour", f"{255 * full:.3g}/255", "brighter"),
        "depth": ("ray parameter t", f"{100 * full:.3g} %", "farther"),
        "normal": ("normal", f"{full:.3g}", "larger"),
    }[channel]
    if signed:
        low, high = f"raster {longer} by {number}", f"ray {longer} by {number}"
        short = f"raster {number}", f"ray {number}"
        return ColorScale(f"ray - raster: {what}", low, "0", high, short)
    return ColorScale(f"difference of the {what}", "", "0", number, ("", number))


def error_text(comparison: Comparison, channel: Channel) -> str:
    """Return the largest and the RMS error of a channel over the whole image."""
    error = comparison.errors[channel]
    if channel == "id":
        return f"another object in {_pixels(error.differing)}"
    if channel == "color":
        numbers = f"max {255 * error.largest:5.1f}/255  RMS {255 * error.rms:7.3f}/255"
    elif channel == "depth":
        numbers = f"max {100 * error.largest:.3g} %  RMS {100 * error.rms:.3g} %"
    else:
        numbers = f"max {error.largest:.3g}  RMS {error.rms:.3g}"
    only = f"  hit in one image only: {error.infinite}" if error.infinite else ""
    return numbers + only


def measured_at(images: ImageOptions) -> str:
    """Return the exposure at which colours are compared, if the images are shown at another;
    otherwise "".
    """
    return "  at 0 EV" if images.channel == "color" and images.exposure_ev else ""


def pixel_values(comparison: Comparison, pixel: Pixel, channel: Channel) -> tuple[str, str, str]:
    """Return both images' values at a pixel, and their difference, as texts."""
    at = np.s_[pixel[0] : pixel[0] + 1, pixel[1] : pixel[1] + 1]
    difference = signed_difference(comparison.raster.part(at), comparison.ray.part(at), channel)
    number = float(difference[0, 0])
    unit, factor = {"color": ("/255", 255.0), "depth": (" %", 100.0)}.get(channel, ("", 1.0))
    told = "" if channel == "id" else f"{factor * number:+.3g}{unit}"
    raster, ray = (
        _value(frame.channel(channel)[pixel]) for frame in (comparison.raster, comparison.ray)
    )
    return raster, ray, told


def cause_at(comparison: Comparison, pixel: Pixel) -> Cause | None:
    """Return why a pixel differs; None if it does not."""
    label = int(comparison.labels[pixel])
    return next((cause for cause in LABELS if cause.label == label), None)


def next_differing(
    comparison: Comparison, after: Pixel | None, forward: bool = True, label: int | None = None
) -> Pixel | None:
    """Return the next pixel that differs, in reading order, starting again at the end; None if
    there is none.

    label: only pixels with this label.
    """
    labels = comparison.labels
    chosen = labels != AGREE if label is None else labels == label
    found = np.flatnonzero(chosen)
    if not len(found):
        return None
    width = comparison.size[0]
    if after is None:
        index = 0 if forward else len(found) - 1
    else:
        here = after[0] * width + after[1]
        index = (
            int(np.searchsorted(found, here, "right"))
            if forward
            else int(np.searchsorted(found, here, "left")) - 1
        )
    row, column = divmod(int(found[index % len(found)]), width)
    return row, column


def stepped(
    state: AppState, comparison: Comparison, forward: bool = True, label: int | None = None
) -> AppState:
    """Return the state with the next differing pixel marked; the same state if there is none."""
    pixel = next_differing(comparison, state.marked, forward, label)
    return state if pixel is None else marked_at(state, pixel, comparison.size)


def at_worst(state: AppState, comparison: Comparison) -> AppState:
    """Return the state with the pixel of the channel's largest error marked."""
    return marked_at(state, comparison.errors[state.images.channel].worst, comparison.size)


def marked_at(state: AppState, pixel: Pixel, size: tuple[int, int]) -> AppState:
    """Return the state with a pixel marked, centred, and large enough to see. size: (width, height)
    of the images.
    """
    large = state.images.magnification or 0.0
    magnification = large if large >= STEP_FROM else MARKED_MAGNIFICATION
    center = ((pixel[1] + 0.5) / size[0], (pixel[0] + 0.5) / size[1])
    return state.with_options(
        replace(state.options, marked=pixel),
        replace(state.options.images, magnification=magnification, center=center),
    )


def _value(value: object) -> str:
    array = np.asarray(value)
    if array.dtype.kind == "i":
        return "none" if int(array) < 0 else f"object {int(array)}"
    if array.ndim:
        return " ".join(f"{number:6.3f}" for number in array.tolist())
    return "no hit" if np.isposinf(array) else f"{float(array):.6g}"


def _pixels(count: int) -> str:
    return f"{count} pixel{'' if count == 1 else 's'}"


def _listed(names: list[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
