"""The mistakes laboratory's model: the lines, the wrong ones, and their effect on the picture.

It knows no window. The lines and their mistakes are in app/checking/mistakes/.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lucida.app.checking.mistakes.program import Mistake, Mistakes, Program
from lucida.app.checking.mistakes.rays import RayTask, camera_rays, ray_program
from lucida.app.images.ray_pictures import RayPainter
from lucida.app.instruments.outside.second_camera import GivenRay, corner_rays
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.app.ui.explaining.breaking import broken
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.pixels import Indexing

Light = NDArray[np.float32]


@dataclass(frozen=True)
class Situation:
    """The inputs of pictures apart from the scene and the wrong lines.

    camera: fitted to size. pixel: the marked one in an image of that size, or None.
    """

    camera: Camera
    size: Size
    indexing: Indexing
    pixel: Pixel | None = None

    @property
    def program(self) -> Program:
        return ray_program(RayTask(self.camera.projection, self.indexing))


@dataclass(frozen=True, eq=False)
class Compared:
    """The pictures of correct and of wrong lines.

    of, mistakes: the request.
    right, wrong: linear light (H, W, 3).
    corners: origins and directions (4, 3) of the wrong rays, as outside.second_camera takes them.
    ray: the marked pixel's ray, from the wrong lines.
    """

    of: Situation
    mistakes: Mistakes
    right: Light
    wrong: Light
    corners: tuple[Floats, Floats]
    ray: GivenRay | None


def situation_of(state: AppState, images: Size) -> Situation:
    """Return the inputs of the pictures. images: the size of the window's own images."""
    size = picture_size(state, images)
    camera = state.view.for_size(size)
    marked, pixel = state.marked, None
    if marked is not None and marked[0] < images[1] and marked[1] < images[0]:
        pixel = scaled_pixel(marked, images, size)
    return Situation(camera, size, state.options.indexing, pixel)


def picture_size(state: AppState, images: Size) -> Size:
    """Return the images' size if they are as coarse as the pictures; otherwise the selected columns
    and the images' aspect ratio.
    """
    columns = state.options.mistakes.columns
    width, height = images if min(images) else (4, 3)
    if state.images.resolution is not None and width <= columns:
        return width, height
    return columns, max(1, min(2 * columns, round(columns * height / width)))


def scaled_pixel(pixel: Pixel, of: Size, size: Size) -> Pixel:
    """Return the pixel at the same place in an image of another size."""
    row, column = (
        (2 * at + 1) * new // (2 * old)  # the pixel that contains its centre
        for at, old, new in zip(pixel, reversed(of), reversed(size), strict=True)
    )
    return row, column


def rays_of(now: Situation, mistakes: Mistakes) -> tuple[Floats, Floats]:
    """Return the origins and directions, (H, W, 3), from the lines with these mistakes."""
    return camera_rays(now.camera, now.size, mistakes, now.indexing)


def compared(painter: RayPainter, now: Situation, mistakes: Mistakes) -> Compared:
    """Return both pictures. Runs on a thread."""
    right = painter.picture(*rays_of(now, ()), now.camera.t_range)
    origins, directions = rays_of(now, mistakes)
    wrong = painter.picture(origins, directions, now.camera.t_range) if mistakes else right
    ray = None
    if now.pixel is not None:
        origin, direction = origins[now.pixel], directions[now.pixel]
        t = painter.hits([origin], [direction], now.camera.t_range)
        ray = GivenRay(origin, direction, float(t[0]))
    return Compared(now, mistakes, right, wrong, corner_rays(origins, directions), ray)


def named(program: Program, names: Iterable[str]) -> Mistakes:
    """Return the program's mistakes with these names, in this order, but at most two that can be
    combined.
    """
    found: list[Mistake] = []
    for name in names:
        for mistake in program.mistakes:
            is_new = mistake.name == name and mistake not in found and len(found) < 2
            if is_new and all(program.can_combine(other, mistake) for other in found):
                found.append(mistake)
    return tuple(found)


def unknown(names: Iterable[str]) -> tuple[str, ...]:
    """Return the names that occur in no program of a ray."""
    known = {
        mistake.name
        for projection in ("perspective", "parallel")
        for indexing in Indexing
        for mistake in ray_program(RayTask(projection, indexing)).mistakes
    }
    return tuple(name for name in names if name not in known)


def of_line(program: Program, key: str) -> Mistakes:
    """Return the mistakes that include a line, the most common first."""
    found = (mistake for mistake in program.mistakes if key in mistake.keys)
    return tuple(sorted(found, key=lambda mistake: not mistake.is_common))


def switched(program: Program, names: Sequence[str], name: str) -> tuple[str, ...]:
    """Return the names after a mistake was switched on or off.

    Mistakes that exclude the new one are switched off; the last of the others stays.
    """
    if name in names:
        return tuple(one for one in names if one != name)
    (new,) = (mistake for mistake in program.mistakes if mistake.name == name)
    others = [one.name for one in named(program, names) if program.can_combine(one, new)]
    return (*others[-1:], name)


def without_line(program: Program, names: Sequence[str], key: str) -> tuple[str, ...]:
    """Return the names after a line was corrected."""
    return tuple(one.name for one in named(program, names) if key not in one.keys)


def folded(code: str, letters: int) -> list[str]:
    """Return the code in rows of at most that many letters."""
    return [row for line in code.split("\n") for row in broken(line, letters)]


def told_difference(changed: NDArray[np.bool_]) -> str:
    """Return the extent of the difference in words."""
    count = int(changed.sum())
    if count == 0:
        return "none: this camera does not show it"
    part = 100 * count / changed.size
    return f"{part:.0f} % of the pixels" if part >= 1 else f"{count} pixels of {changed.size}"
