"""The benchmark's cameras: easy views, hard views, and a camera's rays as arrays.

Knows nothing of who traces.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.lenses import Lens
from tools.benchmarks import interior
from tools.benchmarks.scenes import Subject

FROM = np.array([0.66, 0.42, 0.62]) / np.linalg.norm([0.66, 0.42, 0.62])  # towards the eye
FOV_Y_DEG = 40.0
Rays = NDArray[np.float32]


@dataclass(frozen=True)
class View:
    """A camera under a name, and the size of its image: (width, height)."""

    name: str
    camera: Camera
    size: Size


def easy_views(subject: Subject, size: Size) -> list[View]:
    """Perspective, parallel and skewed; the subject fills the image, about half of it is hit."""
    perspective = look(subject, size)
    far = float(np.linalg.norm(np.array(perspective.eye) - subject.centre))
    left, right, bottom, top = (edge * far / perspective.distance for edge in perspective.viewport)
    parallel = replace(perspective, projection="parallel", viewport=(left, right, bottom, top))
    u, v, w = perspective.basis.T
    skewed = replace(
        perspective,
        u=tuple(1.1 * u + 0.15 * v),
        v=tuple(0.9 * v - 0.1 * u + 0.1 * w),
        w=tuple(0.8 * (w + 0.05 * u)),
        distance=perspective.distance / 0.8,
    )
    return [
        View("perspective", perspective, size),
        View("parallel", parallel, size),
        View("skewed", skewed, size),
    ]


def lens_views(subject: Subject, size: Size) -> list[View]:
    """A pinhole, the same with distortion, and wide lenses from nearby."""
    near = replace(look(subject, size, radii=0.9), distance=1.0)
    ratio, pi = size[0] / size[1], np.pi
    edge = np.radians(95)  # 190 degrees from top to bottom
    pinhole = look(subject, size)
    brown = Lens("brown", {"k1": -0.2, "k2": 0.05, "p1": 0.001})
    fisheye = replace(near, viewport=(-edge * ratio, edge * ratio, -edge, edge))
    return [
        View("pinhole", pinhole, size),
        View("brown", replace(pinhole, lens=brown), size),
        View("pinhole, nearby", look(subject, size, radii=0.9, fov_y_deg=90.0), size),
        View("fisheye, 190 degrees", replace(fisheye, lens=Lens("equidistant")), size),
        View(
            "panorama",
            replace(near, viewport=(-pi, pi, -pi / 2, pi / 2), lens=Lens("equirectangular")),
            size,
        ),
    ]


def hard_views(subject: Subject, size: Size) -> list[View]:
    """Close-up, telephoto, small on the screen, and from inside where the subject has one."""
    views = [
        View("close-up", _close_up(subject, size), size),
        View("telephoto", look(subject, size, radii=360.0, fov_y_deg=0.2), size),
        View("5 % of the screen", look(subject, size, radii=5.0), size),
    ]
    if subject.inside is not None:
        views.append(within(subject, size))
    return views


def interior_views(size: Size) -> list[View]:
    """From within the hall."""
    return [
        View(name, Camera.look_at(eye, at, fov_y_deg=fov, aspect=size[0] / size[1]), size)
        for name, (eye, at, fov) in interior.VIEWS.items()
    ]


def dense_view(subject: Subject, density: float, size: Size) -> View:
    """A sphere, whole in view, from so far that so many triangles that face the eye fall on a pixel
    that it covers."""
    low, high = 3.2, 1000.0  # in radii of the sphere: nearer, it would not be whole in view
    focal = size[1] / 2 / np.tan(np.radians(FOV_Y_DEG / 2))
    while high / low > 1.001:
        away = (low * high) ** 0.5
        facing = subject.triangles * (1 - 1 / away) / 2
        covered = np.pi * focal**2 / (away**2 - 1)
        low, high = (low, away) if facing / covered > density else (away, high)
    radius = float(np.linalg.norm(subject.vertices - subject.centre, axis=1).mean())
    camera = look(subject, size, radii=low * radius / subject.radius)
    return View(f"{density:g} a pixel", camera, size)


def within(subject: Subject, size: Size) -> View:
    """From the subject's inside."""
    eye = np.array(subject.inside)
    camera = Camera.look_at(eye, eye - FROM, fov_y_deg=90.0, aspect=size[0] / size[1])
    return View("inside", camera, size)


def facing(subject: Subject, camera: Camera, size: Size) -> int:
    """Count the triangles that face the eye, with centres within the image, hidden ones included.

    From within a mesh, where none faces the eye, count those that are turned away.
    """
    a, b, c = subject.vertices[subject.faces.T]
    centre = (a + b + c) / 3
    at = camera.project(centre, size)
    column, row = at.column + 0.5, at.row + 0.5
    seen = (column > 0) & (column < size[0]) & (row > 0) & (row < size[1])
    normal = np.cross(b[seen] - a[seen], c[seen] - a[seen])
    back = np.array(camera.w) if camera.is_parallel else np.array(camera.eye) - centre[seen]
    front = int(np.count_nonzero((normal * back).sum(axis=1) > 0))
    return front or len(normal)


def look(subject: Subject, size: Size, radii: float = 1.6, fov_y_deg: float = FOV_Y_DEG) -> Camera:
    """The subject from `radii` times its radius away."""
    eye = subject.centre + FROM * radii * subject.radius
    return Camera.look_at(eye, subject.centre, fov_y_deg=fov_y_deg, aspect=size[0] / size[1])


def _close_up(subject: Subject, size: Size) -> Camera:
    """The vertex nearest to the usual eye from 5 % of the subject's radius."""
    nearest = subject.vertices[np.argmax(subject.vertices @ FROM)].astype(float)
    eye = nearest + FROM * 0.05 * subject.radius
    return Camera.look_at(eye, nearest, fov_y_deg=60.0, aspect=size[0] / size[1])


def rays(camera: Camera, size: Size) -> tuple[Rays, Rays]:
    """Origins and directions, float32 (height * width, 3), row by row from the top left.

    As Camera.rays, made as fast as NumPy can: by one sum of a row and a column a component.
    """
    width, height = size
    x, _ = camera.image_point(0, np.arange(width), size)
    _, y = camera.image_point(np.arange(height), 0, size)
    back = np.zeros(3) if camera.is_parallel else camera.distance * np.array(camera.w)
    start = np.array(camera.eye) if camera.is_parallel else -back
    across, same = np.empty((2, height, width, 3), np.float32)
    for k in range(3):
        row = (x * camera.u[k]).astype(np.float32)
        column = (start[k] + y * camera.v[k]).astype(np.float32)
        np.add(row, column[:, None], out=across[..., k])
    same[:] = [-c for c in camera.w] if camera.is_parallel else camera.eye
    across, same = across.reshape(-1, 3), same.reshape(-1, 3)
    return (across, same) if camera.is_parallel else (same, across)
