"""Find the cause of a difference between two images at a pixel: a nearby discontinuity.

A rasterizer snaps vertices to 1/256 pixel. A pixel whose centre is within TOLERANCE_PX of a line
where the exact image jumps may therefore show either side of it. Both renderers compute in float32,
so the same holds within float32's error of such a line. Everywhere else, the images must agree.

Only lines of the two primitives that the images show at the pixel count. Arithmetic is float64.
Each line is the zero of a smooth function of the position in the image, so that its distance in
pixels is the function's value over its slope:

    edge     an edge of a triangle, the outline of a sphere; where the two surfaces meet; a surface
             so oblique or small that its depth, smooth normal or vertex colours differ as much
             within TOLERANCE_PX
    pattern  a border of a checker's cell or of a hole; a texture that varies as much
    clip     a cut by near or far, or by OpenGL just in front of the eye
    lookup   an edge, a clip line or a hole within half a texel, in the pinhole image in which a
             lens's pixel is looked up
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.lens_faces import looked_up_faces
from lucida.renderer.images.frame import Frame
from lucida.renderer.scene.flat import FlatScene

from .seen_surfaces import (
    TOLERANCE_PX,
    Bools,
    Numbers,
    Surfaces,
    View,
    is_within,
    norm,
    quiet,
    slope_of,
)

CAUSES = ("edge", "pattern", "clip", "lookup")
HALF_TEXEL_PX = 0.5**0.5 + TOLERANCE_PX  # from a texel's middle to its corner
DEPTH_RELATIVE = 1e-4
NORMAL = 1e-3  # per component
ROUNDED_LIGHT = 1e-4  # relative: float32's error in a colour


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

    def part(self, numbers: NDArray[np.intp]) -> Differing:
        return Differing(self.raster, self.ray, self.i[numbers], self.j[numbers])


def explained(
    flat: FlatScene,
    camera: Camera,
    size: tuple[int, int],
    pixels: Differing,
    enlargement: int | None,
) -> NDArray[np.uint8]:
    """Return 1 + the index in CAUSES of the cause for each of n pixels; 0 if there is none.

    enlargement: of the faces in which the raster image of a lens was looked up; None if both images
    were made from the pixels' rays.
    """
    if camera.lens is None:
        return _causes(View(flat, camera, size), pixels, pixels.i, pixels.j)
    faces = looked_up_faces(camera, size, enlargement or 1)
    labels = np.zeros(len(pixels.i), np.uint8)
    for number, face in enumerate(faces.faces):
        (mine,) = np.nonzero(faces.positions[pixels.i, pixels.j, 2] == number)
        if not len(mine):
            continue
        view, part = View(flat, face.camera, face.size, face), pixels.part(mine)
        labels[mine] = _causes(view, part, *faces.place(number, part.i, part.j))
        if enlargement is None:
            continue
        for places in (faces.place(number, part.i, part.j), faces.texel(number, part.i, part.j)):
            near = _parting(view, part, *places, HALF_TEXEL_PX).any(axis=0)
            labels[mine[near & (labels[mine] == 0)]] = 1 + CAUSES.index("lookup")
    return labels


def _causes(view: View, pixels: Differing, i: Numbers, j: Numbers) -> NDArray[np.uint8]:
    """Return labels (n,) like explained(), without lookups. i, j: the places of the pixels' rays in
    this image.
    """
    edge, hole, clip = _parting(view, pixels, i, j, TOLERANCE_PX)
    first, second = pixels.channel("primitive")
    t = pixels.channel("depth").astype(float)
    same = (first == second) & (first >= 0)
    seen = Surfaces(view, second, t[1])
    jumps, is_shade = _jumps(seen, pixels, i, j)
    edge |= same & jumps
    border = same & (seen.checker_px(i, j) <= TOLERANCE_PX)
    light = pixels.channel("color")
    with quiet():
        part = np.abs(light[1] - light[0]) / light.max(axis=0)
    part[(light[0] == light[1]) | (part <= ROUNDED_LIGHT)] = 0
    varies = seen.texture_varies(i, j)
    border |= same & is_shade & (part <= varies).all(axis=1) & varies.any(axis=1)
    return np.select([clip, edge, border | hole], [3, 1, 2], 0).astype(np.uint8)


def _parting(view: View, pixels: Differing, i: Numbers, j: Numbers, px: float) -> Bools:
    """Return masks (3, n) of pixels within `px` of an edge, a hole, or a clip line, which separate
    two primitives.
    """
    primitives, depths = pixels.channel("primitive"), pixels.channel("depth").astype(float)
    first, second = (Surfaces(view, *one) for one in zip(primitives, depths, strict=True))
    edge = first.at_outline(i, j, px) | second.at_outline(i, j, px)
    edge |= _meet(first, second, i, j, px)
    clip = first.at_clip(i, j, px, drawn=True) | second.at_clip(i, j, px)
    differ = primitives[0] != primitives[1]
    hole = differ & (first.at_hole(i, j, px) | second.at_hole(i, j, px))
    return np.array([edge, hole, clip])


def _meet(first: Surfaces, second: Surfaces, i: Numbers, j: Numbers, px: float) -> Bools:
    """Return a mask of pixels within px of the intersection of two primitives' surfaces."""

    def gap(i: Numbers, j: Numbers) -> Floats:
        return first.parameter(i, j) - second.parameter(i, j)

    pair = (first.primitive >= 0) & (second.primitive >= 0)
    pair &= first.primitive != second.primitive
    with quiet():  # the depth buffer's last place
        same = np.abs(gap(i, j)) <= 4e-6 * np.abs(second.t)
    return pair & (same | is_within(gap, i, j, px))


def _jumps(seen: Surfaces, pixels: Differing, i: Numbers, j: Numbers) -> tuple[Bools, Bools]:
    """Return two masks for pixels with the same primitive in both images: its depth, smooth normal
    or vertex colour varies enough within TOLERANCE_PX to explain the difference; depth and normal
    agree.
    """
    t, colors = pixels.channel("depth").astype(float), pixels.channel("color")
    turned = np.abs(np.subtract(*pixels.channel("normal"))).max(axis=1)
    with quiet():
        slopes = slope_of(seen.interpolated, i, j)
        moved = np.abs(t[0] - t[1])
        moved[moved <= DEPTH_RELATIVE * t[1]] = 0
        is_moved = ~(moved <= TOLERANCE_PX * slope_of(seen.parameter, i, j))
        turned[turned <= NORMAL] = 0
        bend = TOLERANCE_PX * norm(slopes[:, :3])
        tint = slopes[:, 3:] / seen.interpolated(i, j)[:, 3:]
        faded = np.abs(colors[1] - colors[0]) / colors.max(axis=0)
        faded[colors[0] == colors[1]] = 0
        fades = (faded <= TOLERANCE_PX * np.nan_to_num(tint)).all(axis=1) & faded.any(axis=1)
    differs = ~((moved == 0) & (turned == 0))
    is_near = ~(is_moved & (moved != 0)) & (turned <= bend)
    return np.where(differs, is_near, fades), ~differs
