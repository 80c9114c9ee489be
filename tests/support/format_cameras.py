"""Random cameras for the camera formats, and a measure of how far two cameras differ."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from trimesh.transformations import quaternion_from_matrix

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.cameras import CameraSet, PosedCamera, read_cameras
from lucida.renderer.files.cameras.given import Given, Options


def skewed_camera(random: np.random.Generator, projection: str = "perspective") -> Camera:
    """Return an off-axis camera with any basis, of either hand."""
    while np.linalg.cond(basis := random.normal(size=(3, 3))) > 50:
        pass
    return _camera(random, basis, projection)


def straight_camera(random: np.random.Generator, projection: str = "perspective") -> Camera:
    """Return a camera with axes at right angles, of any lengths; in perspective w leans, so that
    the viewport is off-axis.
    """
    axes, _ = np.linalg.qr(random.normal(size=(3, 3)))
    axes[:, 0] *= np.linalg.det(axes)
    u, v, w = (axes * random.uniform(0.3, 3, 3)).T
    if projection == "perspective":
        w = w + random.uniform(-0.5, 0.5) * u + random.uniform(-0.5, 0.5) * v
    return _camera(random, (u, v, w), projection)


# Lenses by the programs' names for them: a model of Lens, and its coefficients that are not 0.
LENSES = {
    "simple radial": ("brown", "k1"),
    "radial": ("brown", "k1 k2"),
    "opencv": ("brown", "k1 k2 p1 p2"),
    "plumb bob": ("brown", "k1 k2 k3 p1 p2"),
    "rational": ("brown", "k1 k2 k3 k4 k5 k6 p1 p2"),
    "thin prism": ("brown", "k1 k2 k3 k4 k5 k6 p1 p2 s1 s2 s3 s4"),
    "four radial": ("brown", "k1 k2 k3 r8 p1 p2"),
    "simple fisheye": ("fisheye", "k1"),
    "fisheye": ("fisheye", "k1 k2 k3 k4"),
    "fov": ("fov", "omega"),
    "thin prism fisheye": ("thin_prism_fisheye", "k1 k2 p1 p2 k3 k4 sx1 sy1"),
    **{model: (model, "") for model in ("equidistant", "stereographic", "equisolid")},
    **{model: (model, "") for model in ("orthographic", "equirectangular", "cylindrical")},
}


def lens_camera(random: np.random.Generator, kind: str, square: bool = False) -> Camera:
    """Return an off-axis camera with a lens of LENSES; equirectangular: of the whole sphere.

    Its basis is a rotation times a length. square: its pixels are, in images that are square.
    """
    model, names = LENSES[kind]
    coefficients = {name: 0.02 * random.normal() for name in names.split()}
    lens = Lens(model, {"omega": random.uniform(0.3, 1.2)} if model == "fov" else coefficients)
    axes, _ = np.linalg.qr(random.normal(size=(3, 3)))
    axes[0] *= np.linalg.det(axes)
    distance, (x, y) = random.uniform(0.5, 2), random.uniform(-0.2, 0.2, 2)
    half_x, half_y = random.uniform(0.2, 0.6, 2)
    if square:
        half_y = half_x
    edges = np.array([x - half_x, x + half_x, y - half_y, y + half_y])
    if model == "equirectangular":
        edges = np.pi * np.array([-1, 1, -0.5, 0.5])
    basis = random.uniform(0.3, 3) * axes
    return Camera(5 * random.normal(size=3), *basis, distance, distance * edges, lens=lens)


def centred_camera(random: np.random.Generator, projection: str = "perspective") -> Camera:
    """Return an orthonormal camera whose viewport is centred."""
    axes, _ = np.linalg.qr(random.normal(size=(3, 3)))
    axes[0] *= np.linalg.det(axes)
    return _camera(random, axes, projection, 0.0)


def _camera(
    random: np.random.Generator, basis: object, projection: str, most_shift: float = 1.0
) -> Camera:
    x, y = most_shift * random.uniform(-1, 1, 2)
    half_x, half_y = random.uniform(0.1, 1, 2)
    viewport = (x - half_x, x + half_x, y - half_y, y + half_y)
    return Camera(5 * random.normal(size=3), *basis, random.uniform(0.3, 4), viewport, projection)


def any_size(random: np.random.Generator) -> Size:
    width, height = random.integers(100, 2000, 2).tolist()
    return width, height


def transforms_json(cameras: Sequence[PosedCamera]) -> str:
    """Return cameras in perspective as nerfstudio writes them, with their lenses."""
    frames = []
    for posed in cameras:
        assert posed.size is not None
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = posed.camera.basis, posed.camera.eye
        (fx, _, cx), (_, fy, cy), _ = posed.camera.intrinsics(posed.size, "corner").K.tolist()
        optics: dict[str, Any] = {"fl_x": fx, "fl_y": fy, "cx": cx, "cy": cy}
        optics |= dict(zip("wh", posed.size, strict=True))
        if posed.camera.lens is not None:
            optics |= posed.camera.lens.coefficients
        frames.append({"file_path": posed.name, "transform_matrix": pose.tolist(), **optics})
    lenses = {posed.camera.lens.model for posed in cameras if posed.camera.lens is not None}
    model = "OPENCV_FISHEYE" if "fisheye" in lenses else "OPENCV"
    return json.dumps({"camera_model": model, "frames": frames})


def colmap_model(folder: Path, cameras: list[PosedCamera]) -> None:
    """Write cameras in perspective as COLMAP's text files, without points."""
    texts = {"cameras.txt": "", "images.txt": ""}
    for number, posed in enumerate(cameras, 1):
        assert posed.size is not None
        K, R, t = posed.camera.intrinsics(posed.size, "corner")
        pose = np.eye(4)
        pose[:3, :3] = R
        numbers = K[0, 0], K[1, 1], K[0, 2], K[1, 2]
        texts["cameras.txt"] += (
            " ".join(map(str, (number, "PINHOLE", *posed.size, *numbers))) + "\n"
        )
        turned = *quaternion_from_matrix(pose), *t
        texts["images.txt"] += " ".join(map(str, (number, *turned, number, posed.name))) + "\n\n"
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        (folder / name).write_text(text)


def farthest_px(one: Camera, other: Camera, size: Size, random: np.random.Generator) -> float:
    """Return the largest distance, in pixels, between the images of the same points in two
    cameras.
    """
    row, column = random.uniform(0, 1, (2, 20)) * np.array(size[::-1])[:, None] - 0.5
    ray = one.ray(row, column, size)
    points = ray.origin + random.uniform(0.5, 5, (20, 1)) * ray.direction
    seen = other.project(points, size)
    return float(np.max(np.hypot(seen.row - row, seen.column - column)))


def assert_same_pixels(one: Camera, other: Camera, size: Size) -> None:
    assert farthest_px(one, other, size, np.random.default_rng(0)) < 1e-6


def pasted(text: str | bytes, format: str = "", options: Options | None = None) -> CameraSet:
    data = text if isinstance(text, bytes) else text.encode()
    return read_cameras(Given("pasted", data), format, options)


SKEWED = PosedCamera(Camera(v=(0.5, 1.0, 0.0)), (640, 480), "skewed")
MIRRORED = PosedCamera(Camera(u=(-1.0, 0.0, 0.0)), (640, 480), "mirrored")
ASKANCE = PosedCamera(Camera(w=(0.2, 0.0, 1.0), projection="parallel"), (640, 480), "askance")
