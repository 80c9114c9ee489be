"""OpenCV: cv2.FileStorage reads and writes, cv2.projectPoints says the pixels.

projectPoints takes fx, fy, cx and cy out of K and leaves its skew out: of a camera with one, K, R
and t are read by FileStorage, and K (R p + t) is computed here.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from renderer.camera_checks import Floats
from renderer.camera_formats import Options, read_cameras
from renderer.camera_formats.distortion import COUNTS
from tests.conformance.cameras import (
    Case,
    any_size,
    cases,
    only,
    pixels,
    points_ahead,
    sight,
)
from tests.conformance.measured import Checked, Job, Measured, measured, needed
from tests.support.format_cameras import skewed_camera, straight_camera

CORNER = 0.5  # from OpenCV's (0, 0), a pixel's centre, to the image's corner
FISHEYE = "fisheye"


def check(job: Job) -> Checked:
    cv2 = needed("cv2")
    return Checked(
        f"OpenCV {cv2.__version__}: `cv2.projectPoints`, `cv2.FileStorage`",
        (_ours(cv2, job), _ours_skewed(cv2, job), _theirs(cv2, job), _lenses(cv2, job)),
    )


def _ours(cv2: Any, job: Job) -> Measured:
    errors = []
    for number, case in enumerate(cases(job, straight_camera)):
        for ending in (".yml", ".json"):
            K, R, t, rvec, lens = _stored(cv2, job.folder, case, ending)
            turn = rvec if number % 2 else cv2.Rodrigues(R)[0]
            seen, _ = cv2.projectPoints(case.points, turn, t, K, lens)
            errors.append(seen[:, 0] + CORNER - case.pixels)
    return measured("our .yml and .json, read by cv2", errors, cameras=job.cameras)


def _ours_skewed(cv2: Any, job: Job) -> Measured:
    errors = []
    for case in cases(job, skewed_camera):
        K, R, t, _, _ = _stored(cv2, job.folder, case, ".yml")
        errors.append(sight(K, R, t[:, 0], case.points) + CORNER - case.pixels)
    what = "ours with a skew or a mirror, read by cv2, K (R p + t) by hand"
    return measured(what, errors, cameras=job.cameras)


def _stored(cv2: Any, folder: Path, case: Case, ending: str) -> list[Floats]:
    """K, R, t, rvec and the distortion of our file, as FileStorage has them."""
    path = folder / f"ours{ending}"
    path.write_bytes(case.file("opencv", Options(ending=ending)))
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_READ)
    size = tuple(int(storage.getNode(f"image_{side}").real()) for side in ("width", "height"))
    if size != case.size:
        raise AssertionError(f"cv2 reads the size {size}, not {case.size}")
    names = ("camera_matrix", "R", "t", "rvec", "distortion_coefficients")
    found = [storage.getNode(name).mat() for name in names]
    storage.release()
    return found


def _theirs(cv2: Any, job: Job) -> Measured:
    random, errors = job.random, []
    for number in range(job.cameras):
        size = any_size(random)
        K = _matrix(random, size)
        turn, t = random.normal(size=(3, 1)) * random.choice([1e-6, 1, 1.5]), random.normal(size=3)
        path = job.folder / f"theirs{('.yml', '.json', '.xml')[number % 3]}"
        storage = _calibration(cv2, path, K, size)
        turned = cv2.Rodrigues(turn)[0]
        storage.write("rvec", turn) if number % 2 else storage.write("R", turned)
        storage.write("tvec" if number % 2 else "T", t[:, None])
        storage.release()
        ahead = points_ahead(random)
        points = (ahead - t) @ turned
        seen, _ = cv2.projectPoints(points, turn, t, K, np.zeros(5))
        posed = only(read_cameras(path))
        errors.append(seen[:, 0] + CORNER - pixels(posed.camera, points, posed.size))
    return measured("its .yml, .json and .xml, read by us", errors, cameras=job.cameras)


def _lenses(cv2: Any, job: Job) -> Measured:
    """How far a lens moves the image's farthest corner, by each count of coefficients."""
    random, errors = job.random, []
    kinds: tuple[int | str, ...] = (*COUNTS, FISHEYE)
    for number in range(job.cameras):
        kind = kinds[number % len(kinds)]
        size = any_size(random)
        K = _matrix(random, size)
        lens = 0.02 * random.normal(size=(4 if kind == FISHEYE else kind, 1))
        path = job.folder / "lens.yml"
        storage = _calibration(cv2, path, K, size)
        storage.write("distortion_coefficients", lens)
        if kind == FISHEYE:
            storage.write("fisheye_model", 1)
        storage.release()
        found = only(read_cameras(path, options=Options(ignore_distortion=True))).distortion
        corners = np.array([(x, y) for x in (0, size[0]) for y in (0, size[1])]) - CORNER
        ahead = (corners - K[:2, 2]) / (K[0, 0], K[1, 1])
        if kind == FISHEYE:
            bent = cv2.fisheye.distortPoints(ahead[None], K, lens)[0]
        else:
            deep = np.column_stack([ahead, np.ones(4)])
            bent = cv2.projectPoints(deep, np.zeros(3), np.zeros(3), K, lens)[0][:, 0]
        farthest = np.hypot(*(bent - corners).T).max()
        errors.append((found.corner_px if found else np.nan) - farthest)
    what = "a corner moved by a lens, 4 to 14 coefficients and fisheye"
    return measured(what, errors, cameras=job.cameras, beside=True)


def _calibration(cv2: Any, path: Path, K: Floats, size: tuple[int, int]) -> Any:
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    storage.write("image_width", size[0])
    storage.write("image_height", size[1])
    storage.write("camera_matrix", K)
    return storage


def _matrix(random: np.random.Generator, size: tuple[int, int]) -> Floats:
    """K of a lens from wide to long, off the middle."""
    fx, fy = max(size) * random.uniform(0.8, 3, 2)
    cx, cy = np.array(size) * random.uniform(0.3, 0.7, 2)
    return np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]])
