"""The compare view's texts, causes, and steps from pixel to pixel, without a window."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lucida.app.state.app_state import AppState
from lucida.app.state.options.compare import CompareMode
from lucida.app.state.options.shared import Pixel
from lucida.renderer.compare.raster_and_ray import AGREE, CAUSES, SHADING, UNEXPLAINED, Comparison

MODES: tuple[tuple[CompareMode, str, str], ...] = (
    ("wipe", "Wipe", "Shows the raster image left of the divider, and the ray image right of it."),
    (
        "absolute",
        "Difference",
        "Shows how much the images differ; black is no difference. Colours are compared as display "
        "values (sRGB, exposure 0), and depths relative to the ray image's.",
    ),
)
MARKED_MAGNIFICATION = 32.0  # from this magnification on, pixels show their values
STEP_FROM = 8.0  # pixels are invisible below this, so a step magnifies


@dataclass(frozen=True)
class Cause:
    """A cause of a difference. label: in Comparison.labels. name: short. told: a sentence."""

    label: int
    name: str
    told: str


LABELS = (
    Cause(1, "edge", "There is an edge, or a line where two surfaces meet, within 1/128 pixel."),
    Cause(2, "pattern", "Within 1/128 pixel, a checker, a hole or a texture changes as much."),
    Cause(3, "clip", "Near or far cuts a surface there, or it is too near the eye for OpenGL."),
    Cause(4, "lookup", "The texel looked up by the pixel is past an edge, by up to half a texel."),
    Cause(SHADING, "shading", "Both show the same point, but in different colours."),
    Cause(UNEXPLAINED, "unexplained", "Nothing in the image explains it: a renderer is wrong."),
)
assert len(LABELS) == len(CAUSES) + 2


def counts(comparison: Comparison) -> dict[int, int]:
    """Return the number of pixels for each of LABELS, by label."""
    found = {1 + k: comparison.explained[name] for k, name in enumerate(CAUSES)}
    found[SHADING] = comparison.shading
    found[UNEXPLAINED] = comparison.unexplained - comparison.shading
    return found


def headline(comparison: Comparison, effects: str = "") -> tuple[str, bool]:
    """Return the result in one line, and True if it is good news. effects: see effects_of()."""
    if effects and not comparison.nothing_hit:
        differing = f"{comparison.differing} of {comparison.pixels}"
        return f"Not comparable with {effects}: {differing} differ", False
    text = comparison.verdict()
    is_good = not (comparison.unexplained or comparison.nothing_hit)
    return text[0].upper() + text[1:], is_good


def effects_of(state: AppState) -> str:
    """Return the effects that only the ray image shows, as text; "" for none."""
    on = [name for name in ("shadows", "mirrors") if getattr(state.options, name)]
    return " and ".join(on)


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
    here = -1 if after is None else after[0] * width + after[1]
    right = np.searchsorted(found, here, "right") % len(found)
    index = right if forward else np.searchsorted(found, here, "left") - 1
    row, column = divmod(int(found[index]), width)
    return row, column


def stepped(
    state: AppState, comparison: Comparison, forward: bool = True, label: int | None = None
) -> AppState:
    """Return the state with the next differing pixel marked, centred, and large enough to see; the
    same state if there is none.
    """
    pixel = next_differing(comparison, state.marked, forward, label)
    if pixel is None:
        return state
    (width, height), large = comparison.size, state.images.magnification or 0.0
    magnification = large if large >= STEP_FROM else MARKED_MAGNIFICATION
    center = ((pixel[1] + 0.5) / width, (pixel[0] + 0.5) / height)
    return state.with_options(
        replace(state.options, marked=pixel),
        replace(state.options.images, magnification=magnification, center=center),
    )
