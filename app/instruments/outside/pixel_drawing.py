"""A pixel on the image plane, and the numbers of rows and columns. Pure."""

from __future__ import annotations

from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

from .diagram import Face, Item, Label, Role, Segments, polyline
from .frustum import image_point, pixel_corners

MOST_NUMBERED = 12  # rows or columns that are all numbered


def pixel_square(
    camera: Camera, size: Size, pixel: Pixel, fill: float = 0.0, width: float = 1.6
) -> list[Item]:
    """Return a pixel's edges, and its area with the opacity `fill`."""
    corners = pixel_corners(camera, pixel, size)
    edges = polyline(corners, True)
    items: list[Item] = [Segments("pixel", "mark", edges, width, on_plane=True, layer=3)]
    if fill:
        items.insert(0, Face("pixel", "mark", corners, fill, on_plane=True, layer=2))
    return items


def pixel_numbers(
    camera: Camera, size: Size, marked: Pixel | None, base: int, step: int
) -> list[Item]:
    """Return the numbers of rows, at the left of the image plane, and of columns, above it.

    base: the number of the first row and column. step: the least step between numbers. Only the
    first, the last and the marked pixel have numbers in images larger than MOST_NUMBERED.
    """
    left, _, _, top = camera.viewport
    items: list[Item] = []
    for axis, count in enumerate(size[::-1]):
        chosen = {0}
        if max(size) <= MOST_NUMBERED:
            chosen = set(range(0, count, step))
        for extra in (count - 1, *(() if marked is None else (marked[axis],))):
            chosen = {k for k in chosen if abs(k - extra) >= step} | {extra}
        for k in sorted(chosen):
            row, column = (k, 0) if axis == 0 else (0, k)
            x, y = (float(one) for one in camera.image_point(row, column, size))
            edge = (left, y) if axis == 0 else (x, top)
            is_marked = marked is not None and k == marked[axis]
            at, inside = image_point(camera, *edge), image_point(camera, x, y)
            name = f"{'row' if axis == 0 else 'column'} {k}"
            role: Role = "mark" if is_marked else "text"
            items.append(
                Label(name, role, str(k + base), at, away=inside, strong=is_marked, fixed=True)
            )
    return items
