"""A drawing of the first wrong ray next to the correct one, with eye and viewport, as SVG.

The view is from the side, in the frustum's coordinates (picture.py), so that the correct ray always
goes from the left through the viewport. Colours and dashes are the page's: classes `right`,
`given`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from app.checking.reports.picture import DEPTH, in_frustum
from renderer.camera import Camera, Size

Floats = NDArray[np.float64]

# The frustum's X, Y and Z on paper: depth to the right, X towards the reader.
AXES = np.array([[0.36, 0.24], [0.0, -1.0], [-1.8, 0.0]])
BEYOND = 1.6  # length of both rays; 1 reaches the viewport
FAR = 4.0  # more distant origins are drawn at the paper's edge
UNIT = 90.0  # in the drawing, for 1 in the frustum
MARGIN = 34.0


def sketch(camera: Camera, size: Size, right: Floats, given: Floats) -> str:
    """Return an <svg> element.

    right, given: rays (2, 3) of the world, origin and direction. A given ray that is invalid is not
    drawn.
    """
    scale = DEPTH if camera.is_parallel else 1.0
    across = size[0] / size[1]
    corners = [(x, y, -1.0) for x, y in ((-across, -1), (across, -1), (across, 1), (-across, 1))]
    paper = _on_paper(np.array(corners))
    shapes = [_path(paper, "viewport", closed=True)]
    if not camera.is_parallel:
        eye = _on_paper(np.zeros((1, 3)))
        shapes += [_path(np.array([eye[0], corner]), "edge") for corner in paper]
    drawn = [paper, _on_paper(np.zeros((1, 3)))]
    inside = [in_frustum(camera, size, ray) / scale for ray in (right, given)]
    to_viewport = inside[0][1] / -inside[0][1][2]
    length = BEYOND * float(np.linalg.norm(to_viewport))
    for name, ray in zip(("right", "given"), inside, strict=True):
        ends = _ends(ray, length)
        if ends is not None:
            line = _on_paper(ends)
            drawn.append(line)
            shapes += [_path(line, name), _head(line, name)]
    x, y = _on_paper(np.zeros((1, 3)))[0]
    px, py = _on_paper(inside[0][:1] + to_viewport)[0]
    shapes.append(f'<circle class="right" cx="{px:.1f}" cy="{py:.1f}" r="4"/>')
    shapes.append(f'<circle class="eye" cx="{x:.1f}" cy="{y:.1f}" r="4"/>')
    shapes.append(f'<text x="{x:.1f}" y="{y + 18:.1f}" text-anchor="middle">eye</text>')
    least, most = (getattr(np.vstack(drawn), name)(axis=0) for name in ("min", "max"))
    left, top = least - MARGIN
    width, height = most - least + 2 * MARGIN
    box = f"{left:.1f} {top:.1f} {width:.1f} {height:.1f}"
    return (
        f'<svg class="sketch" viewBox="{box}" role="img" '
        f'aria-label="The correct ray and the given one">{"".join(shapes)}</svg>'
    )


def _on_paper(points: Floats) -> Floats:
    return points @ AXES * UNIT


def _ends(ray: Floats, shown: float) -> Floats | None:
    """Return the start of a ray and the end of its arrow; None for an invalid ray."""
    origin, direction = ray
    length = np.linalg.norm(direction)
    if not (np.isfinite(ray).all() and length > 0):
        return None
    away = np.linalg.norm(origin)
    origin = origin * min(1.0, FAR / away) if away > 0 else origin
    return np.array([origin, origin + shown * direction / length])


def _path(points: Floats, name: str, closed: bool = False) -> str:
    steps = " L".join(f"{x:.1f} {y:.1f}" for x, y in points)
    return f'<path class="{name}" d="M{steps}{" Z" if closed else ""}"/>'


def _head(line: Floats, name: str) -> str:
    """Return the arrow's head."""
    along = line[1] - line[0]
    length = np.linalg.norm(along)
    if length < 1:  # points towards the reader
        return f'<circle class="{name}" cx="{line[1, 0]:.1f}" cy="{line[1, 1]:.1f}" r="5"/>'
    along = along / length * 11
    side = np.array([-along[1], along[0]]) * 0.4
    points = np.array([line[1], line[1] - along + side, line[1] - along - side])
    return _path(points, f"{name} head", closed=True)
