"""Meshes from formulas, of about any number of triangles.

Knows nothing of what is measured with them. All but the soup are closed, wound counter-clockwise as
seen from outside, and about 2 to 4 units large.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Vertices = NDArray[np.float32]
Faces = NDArray[np.int32]


def knot(triangles: int, radius: float = 0.28) -> tuple[Vertices, Faces]:
    """A (2, 3) torus knot with a bumpy tube of the given radius, of about that many triangles."""
    around = max(3, round((triangles / 14) ** 0.5))
    along = max(8, round(triangles / (2 * around)))
    s = np.arange(along) * (2 * np.pi / along)
    a = np.arange(around) * (2 * np.pi / around)

    def centre(s: np.ndarray) -> np.ndarray:
        r = 1 + 0.45 * np.cos(3 * s)
        return np.stack([r * np.cos(2 * s), 0.55 * np.sin(3 * s), -r * np.sin(2 * s)], axis=-1)

    tangent = centre(s + 1e-4) - centre(s - 1e-4)
    normal = np.cross(tangent, (0.0, 1.0, 0.0))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    binormal = np.cross(tangent, normal)
    binormal /= np.linalg.norm(binormal, axis=1, keepdims=True)
    ring = np.cos(a)[:, None] * normal[:, None] + np.sin(a)[:, None] * binormal[:, None]
    bumps = 0.03 * np.sin(40 * s[:, None]) * np.sin(11 * a)
    bumps += 0.1 * np.sin(7 * s[:, None]) * np.cos(3 * a)
    vertices = centre(s)[:, None] + (radius * (1 + bumps))[..., None] * ring
    # Quads between a ring and the next one, in two triangles each.
    i, j = np.arange(along)[:, None], np.arange(around)
    here, there = i * around, (i + 1) % along * around
    k = (j + 1) % around
    p, q, r, t = here + j, there + j, there + k, here + k
    faces = np.stack([p, r, q, p, t, r], axis=-1).reshape(-1, 3)
    return vertices.reshape(-1, 3).astype(np.float32), faces.astype(np.int32)


def bumpy_sphere(triangles: int) -> tuple[Vertices, Faces]:
    """A dented unit sphere, a cube's grid blown up, of about that many triangles.

    From its centre every ray hits: the surface is one radius for each direction.
    """
    n = max(1, round((triangles / 12) ** 0.5))
    sides = []
    for axis in range(3):
        for side in (0, n):
            # Points of one side, whole coordinates 0 to n; first x second = axis, turned outwards.
            first, second = (axis + 1) % 3, (axis + 2) % 3
            if side == 0:
                first, second = second, first
            points = np.empty((n + 1, n + 1, 3), np.int64)
            points[..., axis] = side
            points[..., first] = np.arange(n + 1)[:, None]
            points[..., second] = np.arange(n + 1)
            a, b, c, d = points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]
            sides.append(np.stack([a, b, c, a, c, d], axis=2).reshape(-1, 3))
    # Whole coordinates tell which corners are the same vertex.
    corners = np.concatenate(sides)
    number = (corners[:, 0] * (n + 1) + corners[:, 1]) * (n + 1) + corners[:, 2]
    _, first_use, faces = np.unique(number, return_index=True, return_inverse=True)
    grid = np.tan((corners[first_use] / n * 2 - 1) * (np.pi / 4))  # cells of about equal area
    v = grid / np.linalg.norm(grid, axis=1, keepdims=True)
    bumps = 0.12 * np.sin(v @ [7, 3, 5.0]) * np.sin(v @ [-4, 9, 2.0])
    bumps += 0.02 * np.sin(v @ [31, 17, -23.0]) + 0.006 * np.sin(v @ [97, -61, 43.0])
    return (v * (1 + bumps)[:, None]).astype(np.float32), faces.reshape(-1, 3).astype(np.int32)


def block(size: tuple[float, float, float]) -> tuple[Vertices, Faces]:
    """A box of 12 triangles about the origin, its vertices shared."""
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    faces = np.array(quads)[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    return (signs * np.array(size) / 2).astype(np.float32), faces.astype(np.int32)


def placed(
    part: tuple[Vertices, Faces], scale: float, offset: tuple[float, float, float]
) -> tuple[Vertices, Faces]:
    """The mesh scaled, then moved."""
    return (part[0] * scale + np.array(offset)).astype(np.float32), part[1]


def joined(*parts: tuple[Vertices, Faces]) -> tuple[Vertices, Faces]:
    """One mesh of several."""
    first = np.cumsum([0, *(len(vertices) for vertices, _ in parts)])
    vertices = np.concatenate([vertices for vertices, _ in parts])
    faces = [faces + start for (_, faces), start in zip(parts, first, strict=False)]
    return vertices, np.concatenate(faces).astype(np.int32)


def table_top(triangles: int) -> tuple[Vertices, Faces]:
    """A knot and two dented spheres on a board: small triangles and a few very large ones."""
    share = (triangles - 12) // 3
    ball = bumpy_sphere(share)
    return joined(
        placed(knot(share), 0.6, (0.0, 0.0, 0.0)),
        placed(ball, 0.45, (1.1, 0.0, 0.9)),
        placed(ball, 0.35, (-1.0, -0.1, 1.1)),
        placed(block((4.0, 0.1, 4.0)), 1.0, (0.0, -0.6, 0.0)),
    )


def scanned_sphere(triangles: int) -> tuple[Vertices, Faces]:
    """The dented sphere as a scanner would give it: rough at every scale, down to its triangles.

    As with bumpy_sphere, every ray from its centre hits.
    """
    vertices, faces = bumpy_sphere(triangles)
    v = vertices.astype(float)
    rng = np.random.default_rng(7)
    edge = (4 * np.pi / (0.43 * triangles)) ** 0.5
    rough, length = np.zeros(len(v)), 0.5
    while length > 3 * edge:
        a, b = rng.normal(size=(2, 3)) * (2 * np.pi / length)
        rough += 0.04 * length * np.sin(v @ a) * np.sin(v @ b)
        length /= 1.8
    rough += 0.15 * edge * rng.normal(size=len(v))
    return (v * (1 + rough)[:, None]).astype(np.float32), faces


def soup(triangles: int, length: float = 0.06) -> tuple[Vertices, Faces]:
    """Triangles anyhow in a cube, their edges about that long."""
    rng = np.random.default_rng(9)
    centres = rng.uniform(-1, 1, (triangles, 1, 3))
    corners = centres + rng.normal(size=(triangles, 3, 3)) * (length / 2.4)
    faces = np.arange(3 * triangles).reshape(-1, 3)
    return corners.reshape(-1, 3).astype(np.float32), faces.astype(np.int32)


def prism(outline: NDArray[np.floating], height: float) -> tuple[Vertices, Faces]:
    """A solid over an outline in the xz plane, (n, 2), star-shaped about the origin; y from 0.

    As programs for construction write it: walls of two long triangles, caps of slivers.
    """
    n = len(outline)
    vertices = np.zeros((2 * n + 2, 3))
    vertices[:n, [0, 2]] = vertices[n : 2 * n, [0, 2]] = outline
    vertices[n : 2 * n, 1] = vertices[-1, 1] = height
    i = np.arange(n)
    j = (i + 1) % n
    low, high = np.full(n, 2 * n), np.full(n, 2 * n + 1)
    faces = [(i, n + i, n + j), (i, n + j, j), (low, i, j), (high, n + j, n + i)]
    return vertices.astype(np.float32), np.concatenate([np.stack(f, 1) for f in faces])


def subdivided(part: tuple[Vertices, Faces]) -> tuple[Vertices, Faces]:
    """Each triangle in four, at the middles of its edges: flat stays flat, thin stays thin."""
    vertices, faces = part
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1).astype(np.int64)
    keys, middle = np.unique(edges[:, 0] * len(vertices) + edges[:, 1], return_inverse=True)
    ends = vertices[np.stack(np.divmod(keys, len(vertices)))]
    a, b, c = faces.T
    p, q, r = (middle.reshape(-1, 3) + len(vertices)).T
    four = np.stack([a, p, r, p, b, q, r, q, c, p, q, r], axis=1).reshape(-1, 3)
    return np.concatenate([vertices, ends.mean(0)]), four.astype(np.int32)


def machine_parts(times: int) -> tuple[Vertices, Faces]:
    """Wheels, bolts, and rods on a plate, 2,976 triangles, subdivided that many times."""

    def circle(corners: int, radius: float, teeth: float = 0.0) -> NDArray[np.float64]:
        turn = np.arange(corners) * (2 * np.pi / corners)
        radii = radius * (1 + teeth * (np.arange(corners) // 2 % 2))
        return np.stack([np.cos(turn), np.sin(turn)], 1) * radii[:, None]

    parts = [placed(block((3.2, 0.2, 3.2)), 1.0, (0.0, -0.1, 0.0))]
    for x, z in [(-0.9, -0.9), (0.9, -0.9), (-0.9, 0.9), (0.9, 0.9)]:
        parts.append(placed(prism(circle(96, 0.5, teeth=0.2), 0.3), 1.0, (x, 0.0, z)))
        parts.append(placed(prism(circle(48, 0.2), 1.0), 1.0, (x, 0.3, z)))
    for k in range(9):
        x = 0.3 * (k - 4)
        parts.append(placed(prism(circle(6, 0.1), 0.12), 1.0, (x, 0.0, 0.0)))
        parts.append(placed(prism(circle(12, 0.05), 1.4), 1.0, (x, 0.0, 0.15)))
    parts.append(placed(block((0.3, 0.8, 0.1)), 1.0, (0.0, 0.4, -0.9)))
    made = joined(*parts)
    for _ in range(times):
        made = subdivided(made)
    return made
