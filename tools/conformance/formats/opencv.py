"""OpenCV: cv2.FileStorage reads and writes, cv2.projectPoints computes the pixels.

projectPoints uses fx, fy, cx and cy of K and ignores its skew. For a camera with skew, FileStorage
reads K, R and t, and K (R p + t) is computed here.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from lucida.renderer.camera.checks import Floats
from lucida.renderer.files.cameras import Options, read_cameras
from lucida.renderer.files.cameras.distortion import COUNTS
from tests.support.format_cameras import skewed_camera, straight_camera
from tools.conformance.cameras import (
    Case,
    any_size,
    cases,
    lens_cases,
    only,
    pixels,
    points_ahead,
    sight,
)
from tools.conformance.measured import Checked, Job, Measured, measured, needed

CORNER = 0.5  # from OpenCV's (0, 0), a pixel's centre, to the image's corner
FISHEYE = "fisheye"
KINDS = (
    *("simple radial", "radial", "opencv", "plumb bob", "rational", "thin prism"),
    *("simple fisheye", "fisheye", "equidistant"),
)


def check(job: Job) -> Checked:
    cv2 = needed("cv2")
    return Checked(
        f"OpenCV {cv2.__version__}: `cv2.projectPoints`, `cv2.FileStorage`",
        (
            _ours(cv2, job),
            _ours_skewed(cv2, job),
            _theirs(cv2, job),
            _our_lenses(cv2, job),
            _lenses(cv2, job),
        ),
    )


def _ours(cv2: Any, job: Job) -> Measured:
    errors = []
    for case in cases(job, straight_camera):
        K, R, t, lens = _stored(cv2, job.folder, case)
        seen, _ = cv2.projectPoints(case.points, cv2.Rodrigues(R)[0], t, K, lens)
        errors.append(seen[:, 0] + CORNER - case.pixels)
    return measured("our .yml, read by cv2", errors)


def _ours_skewed(cv2: Any, job: Job) -> Measured:
    errors = []
    for case in cases(job, skewed_camera):
        K, R, t, _ = _stored(cv2, job.folder, case)
        errors.append(sight(K, R, t[:, 0], case.points) + CORNER - case.pixels)
    return measured("ours with a skew or a mirror, read by cv2, K (R p + t) by hand", errors)


def _our_lenses(cv2: Any, job: Job) -> Measured:
    errors = []
    for case in lens_cases(job, KINDS):
        K, R, t, lens = _stored(cv2, job.folder, case)
        turn = cv2.Rodrigues(R)[0]
        project = cv2.fisheye.projectPoints if lens.size == 4 else cv2.projectPoints
        seen, _ = project(case.points[:, None], turn, t, K, lens)
        errors.append(seen.reshape(-1, 2) + CORNER - case.pixels)
    return measured(f"our lenses, {len(KINDS)} kinds", errors, beside=True)


def _stored(cv2: Any, folder: Path, case: Case) -> list[Floats]:
    """Return K, R, t and the distortion that FileStorage reads in our file."""
    path = folder / "ours.yml"
    path.write_bytes(case.file("opencv", Options()))
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_READ)
    size = tuple(int(storage.getNode(f"image_{side}").real()) for side in ("width", "height"))
    if size != case.size:
        raise AssertionError(f"cv2 reads the size {size}, not {case.size}")
    names = ("camera_matrix", "R", "t", "distortion_coefficients")
    found = [storage.getNode(name).mat() for name in names]
    storage.release()
    return found


def _theirs(cv2: Any, job: Job) -> Measured:
    random, errors = job.random, []
    for number in range(job.cameras):
        size, K = _calibration(random)
        turn, t = random.normal(size=(3, 1)) * random.choice([1e-6, 1, 1.5]), random.normal(size=3)
        rotation = cv2.Rodrigues(turn)[0]
        pose = (
            {"rvec": turn, "tvec": t[:, None]} if number % 2 else {"R": rotation, "T": t[:, None]}
        )
        path = job.folder / f"theirs{('.yml', '.json', '.xml')[number % 3]}"
        _write(cv2, path, size, camera_matrix=K, **pose)
        ahead = points_ahead(random)
        points = (ahead - t) @ rotation
        seen, _ = cv2.projectPoints(points, turn, t, K, np.zeros(5))
        posed = only(read_cameras(path))
        errors.append(seen[:, 0] + CORNER - pixels(posed.camera, points, posed.size))
    return measured("its .yml, .json and .xml, read by us", errors)


def _lenses(cv2: Any, job: Job) -> Measured:
    """Measure where it sees the directions that our lens has at pixels, for each count of
    coefficients but that with a tilted sensor.
    """
    random, errors = job.random, []
    kinds: tuple[int | str, ...] = (*COUNTS[:-1], FISHEYE)
    for number in range(job.cameras):
        kind = kinds[number % len(kinds)]
        size, K = _calibration(random)
        lens = 0.02 * random.normal(size=(4 if kind == FISHEYE else kind, 1))
        path = job.folder / "lens.yml"
        model = {"fisheye_model": 1} if kind == FISHEYE else {}
        _write(cv2, path, size, camera_matrix=K, distortion_coefficients=lens, **model)
        found = only(read_cameras(path)).camera.lens
        assert found is not None
        places = random.uniform((0, 0), size, (20, 2))
        ahead = found.direction(*((places - K[:2, 2]) / (K[0, 0], K[1, 1])).T)
        project = cv2.fisheye.projectPoints if kind == FISHEYE else cv2.projectPoints
        still = np.zeros(3)
        seen = project(np.stack(ahead, axis=1)[:, None], still, still, K, lens)[0]
        errors.append(seen.reshape(-1, 2) - places)
    what = "pixels' rays through a lens, 4 to 12 coefficients and fisheye"
    return measured(what, errors, beside=True)


def _write(cv2: Any, path: Path, size: tuple[int, int], **values: Any) -> None:
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    for name, value in {"image_width": size[0], "image_height": size[1], **values}.items():
        storage.write(name, value)
    storage.release()


def _calibration(random: np.random.Generator) -> tuple[tuple[int, int], Floats]:
    """Return an image's size, and K of a lens from wide to long, off the middle."""
    size = any_size(random)
    fx, fy = max(size) * random.uniform(0.8, 3, 2)
    cx, cy = np.array(size) * random.uniform(0.3, 0.7, 2)
    return size, np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
