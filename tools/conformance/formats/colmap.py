"""COLMAP: pycolmap writes models, text and binary, and computes the pixels."""

from __future__ import annotations

from typing import Any

import numpy as np

from lucida.renderer.files.cameras import read_cameras
from lucida.renderer.files.cameras.colmap_lenses import LENSES, MODELS
from tools.conformance.cameras import any_size, pixels, points_ahead
from tools.conformance.measured import Checked, Job, Measured, measured, needed


def check(job: Job) -> Checked:
    pycolmap = needed("pycolmap")
    theirs = [_theirs(pycolmap, job, kind) for kind in ("text", "binary")]
    return Checked(
        f"pycolmap {pycolmap.__version__}: `Reconstruction`, `img_from_cam`",
        (
            *theirs,
            _lenses(pycolmap, job),
        ),
    )


def _theirs(pycolmap: Any, job: Job, kind: str) -> Measured:
    random, model, expected = job.random, pycolmap.Reconstruction(), {}
    for number in range(job.cameras):
        camera = _add_camera(pycolmap, model, random, number, ["PINHOLE", "SIMPLE_PINHOLE"])
        turn = random.normal(size=4)
        turn = pycolmap.Rotation3d(turn / np.linalg.norm(turn))
        pose = pycolmap.Rigid3d(turn, 3 * random.normal(size=3))
        name = f"folder/image {number}.jpg" if kind == "binary" else f"folder/{number}.jpg"
        image = pycolmap.Image(name=name, camera_id=number + 1, image_id=number + 1)
        found = [pycolmap.Point2D(random.uniform(0, 100, 2)) for _ in range(number % 4)]
        image.points2D = pycolmap.Point2DList(found)
        model.add_image_with_trivial_frame(image, pose)
        ahead = points_ahead(random)
        seen = np.array([camera.img_from_cam(point) for point in ahead])
        expected[name] = np.array([pose.inverse() * point for point in ahead]), seen
    folder = job.folder / kind
    folder.mkdir()
    (model.write_text if kind == "text" else model.write_binary)(str(folder))
    errors = []
    for posed in read_cameras(folder).cameras:
        points, seen = expected.pop(posed.name)
        errors.append(pixels(posed.camera, points, posed.size) - seen)
    if expected:
        raise AssertionError(f"{len(expected)} images are missing")
    return measured(f"its model as {kind}, read by us", errors)


def _lenses(pycolmap: Any, job: Job) -> Measured:
    """Measure where it sees the directions that our lens has at pixels, for each of its models."""
    random, model, theirs = job.random, pycolmap.Reconstruction(), {}
    bent = [name for name in LENSES if "PINHOLE" not in name]
    for number in range(job.cameras):
        camera = _add_camera(pycolmap, model, random, number, bent)
        image = pycolmap.Image(name=f"{number}.jpg", camera_id=number + 1, image_id=number + 1)
        model.add_image_with_trivial_frame(image, pycolmap.Rigid3d())
        theirs[image.name] = camera
    folder = job.folder / "lenses"
    folder.mkdir()
    model.write_binary(str(folder))
    found = read_cameras(folder).cameras
    errors = []
    for posed in found:
        assert posed.camera.lens is not None and posed.size is not None
        places = random.uniform((0, 0), posed.size, (20, 2))
        K = posed.camera.intrinsics(posed.size, "corner").K
        ahead = posed.camera.lens.direction(*((places - K[:2, 2]) / np.diag(K)[:2]).T)
        seen = [theirs[posed.name].img_from_cam(point) for point in np.transpose(ahead)]
        errors.append(seen - places)
    return measured(f"pixels' rays through a lens, {len(bent)} models", errors, beside=True)


def _add_camera(
    pycolmap: Any, model: Any, random: np.random.Generator, number: int, kinds: list[str]
) -> Any:
    """Add a camera of one of the kinds to a model. Return it."""
    kind, size = kinds[number % len(kinds)], any_size(random)
    ranges = {"cx": (0.3 * size[0], 0.7 * size[0]), "cy": (0.3 * size[1], 0.7 * size[1])}
    ranges |= dict.fromkeys(("f", "fx", "fy"), (0.8 * max(size), 3.0 * max(size)))
    ranges |= {"omega": (0.2, 1.2), "w": (size[0], size[0]), "h": (size[1], size[1])}
    values = [random.uniform(*ranges.get(name, (-0.02, 0.02))) for name in MODELS[kind]]
    width, height = size
    camera = pycolmap.Camera(
        model=kind, width=width, height=height, params=values, camera_id=number + 1
    )
    model.add_camera_with_trivial_rig(camera)
    return camera
