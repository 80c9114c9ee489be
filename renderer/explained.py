"""Which line of the image explains that two images differ at a pixel; see renderer/compare.py."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from renderer.camera import Floats
from renderer.edges import Discontinuities
from renderer.frame import Frame
from renderer.seen_surfaces import Bools, Ints, Numbers

TOLERANCE_PX = 1 / 128
DEPTH_RELATIVE = 1e-4
NORMAL = 1e-3  # per component
ROUNDED_LIGHT = 1e-4  # relative: float32's error in a colour
HALF_TEXEL = 0.5**0.5 + TOLERANCE_PX  # from a texel's middle to its corner

LINES = ("outline", "meeting", "clip", "checker", "texture", "grazing", "cutout")
PARTING = ("outline", "meeting", "clip", "cutout")  # which part two primitives


@dataclass(frozen=True)
class Differing:
    """Pixels (i, j) at which the raster image and the ray image differ, with all channels."""

    raster: Frame
    ray: Frame
    i: NDArray[np.intp]
    j: NDArray[np.intp]

    def channel(self, name: str) -> NDArray:
        """Return both images' values, (2, n, ...)."""
        return np.stack([frame.channel(name)[self.i, self.j] for frame in (self.raster, self.ray)])

    @property
    def seen(self) -> tuple[tuple[Ints, Floats], tuple[Ints, Floats]]:
        """The primitive and the ray parameter in either image."""
        primitives, depths = self.channel("primitive"), self.channel("depth").astype(float)
        return (primitives[0], depths[0]), (primitives[1], depths[1])

    def part(self, numbers: NDArray[np.intp]) -> Differing:
        return Differing(self.raster, self.ray, self.i[numbers], self.j[numbers])


def line_causes(
    lines: Discontinuities, pixels: Differing, i: Numbers, j: Numbers, of_pixel: bool = True
) -> NDArray[np.uint8]:
    """Return for each of n pixels 1 + the index in LINES of the line that explains it; 0 for none.

    i, j: (n,), where its ray is in the image of `lines`. of_pixel: False for another ray near it,
    where only lines count that part what is seen.
    """
    (first, t_first), (second, t_second) = pixels.seen
    same = (first == second) & (first >= 0)
    # The cases in the order of LINES, each as a distance in pixels.
    distances = [
        np.fmin(lines.outline_px(first, i, j), lines.outline_px(second, i, j)),
        lines.meeting_px(first, second, i, j, t_second),
        np.fmin(
            lines.clip_px(first, i, j, t_first, drawn=True), lines.clip_px(second, i, j, t_second)
        ),
        np.where(same, lines.checker_px(second, i, j, t_second), np.inf),
    ]
    # The distance to a point with the other image's depth and normal, if they differ; otherwise,
    # to a point with its vertices' colours.
    turned = np.abs(np.subtract(*pixels.channel("normal"))).max(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        difference = np.abs(t_first - t_second)
        moved = difference / lines.slope(second, i, j, t_second)
        moved[difference <= DEPTH_RELATIVE * t_second] = 0
        normal_slope, unknown = lines.normal_slope(second, i, j)
        bent = turned / normal_slope
        bent[turned <= unknown] = TOLERANCE_PX
        bent[turned <= NORMAL] = 0
        colors = pixels.channel("color")
        faded = np.abs(colors[1] - colors[0]) / (
            colors.max(axis=0) * lines.tint_slope(second, i, j)
        )
        faded[colors[0] == colors[1]] = 0
    # If only the colour differs: does the texture vary as much nearby?
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.abs(colors[1] - colors[0]) / colors.max(axis=0)
    part[(colors[0] == colors[1]) | (part <= ROUNDED_LIGHT)] = 0
    varies = lines.texture_varies(second, i, j, t_second, TOLERANCE_PX)
    is_varied = (
        same & (moved <= 0) & (bent <= 0) & (part <= varies).all(axis=1) & varies.any(axis=1)
    )
    distances.append(np.where(is_varied, 0.0, np.inf))
    jump = np.where((moved > 0) | (bent > 0), np.maximum(moved, bent), faded.max(axis=1))
    distances.append(np.where(same & (jump > 0), jump, np.inf))
    at_hole = lines.is_at_hole(first, i, j, t_first, TOLERANCE_PX)
    at_hole |= lines.is_at_hole(second, i, j, t_second, TOLERANCE_PX)
    distances.append(np.where(at_hole & (first != second), 0.0, np.inf))
    labels = np.zeros(len(i), np.uint8)
    for label in range(len(LINES), 0, -1):
        if not of_pixel and LINES[label - 1] not in PARTING:
            continue
        labels[distances[label - 1] <= TOLERANCE_PX] = label
    return labels


def looked_up(
    lines: Discontinuities,
    pixels: Differing,
    here: tuple[Numbers, Numbers],
    there: tuple[Numbers, Numbers],
) -> Bools:
    """Return which pixels differ since the texel that they looked up sees something else.

    here, there: where the rays of the pixels, and of the texels' middles, are in the image of
    `lines`. The raster image shows what is in front there: either it is not on the pixel's own ray,
    or what is on that is not on the texel's, or the one that is nearer changes between them.
    """
    (first, t_first), (second, t_second) = pixels.seen
    missed = (first >= 0) & ~lines.sees(first, *here, t_first)
    missed |= (second >= 0) & ~lines.sees(second, *there, t_second)
    with np.errstate(invalid="ignore"):
        before, after = (
            lines.parameter(first, *place, t_first) - lines.parameter(second, *place, t_second)
            for place in (here, there)
        )
        missed |= (before > 0) != (after > 0)
    missed |= lines.is_at_hole(first, *here, t_first, HALF_TEXEL)
    missed |= lines.is_at_hole(second, *here, t_second, HALF_TEXEL)
    different: Bools = missed & (first != second)
    return different
