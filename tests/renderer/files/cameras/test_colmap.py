"""COLMAP's models, there and back: as its documentation prints them, and random ones."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files.cameras import PosedCamera, read_cameras, written
from lucida.renderer.system.errors import LucidaError

CAMERAS = """\
# Camera list with one line of data per camera:
#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
# Number of cameras: 3
1 SIMPLE_PINHOLE 3072 2304 2559.81 1536 1152
2 PINHOLE 3072 2304 2560.56 2560.56 1536 1152
3 SIMPLE_RADIAL 3072 2304 2559.69 1536 1152 -0.0218531
"""
IMAGES = """\
# Image list with two lines of data per image:
#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME
#   POINTS2D[] as (X, Y, POINT3D_ID)
# Number of images: 2, mean observations per image: 2
1 0.851773 0.0165051 0.503764 -0.142941 -0.737434 1.02973 3.74354 1 P1180141.JPG
2362.39 248.498 58396 1784.7 268.254 59027 1784.7 268.254 -1
2 0.851773 0.0165051 0.503764 -0.142941 -0.737434 1.02973 3.74354 2 sub/P1180142.JPG

"""
POINTS = """\
# 3D point list with one line of data per point:
#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)
# Number of points: 3, mean track length: 3.3334
63390 1.67241 0.292931 0.609726 115 121 122 1.33927 16 6542 15 7345 6 6714 14 7227
63376 2.01848 0.108877 -0.0260841 102 209 250 1.73449 16 6519 15 7322 14 7212 8 3991
63371 1.71102 0.28566 0.53475 245 251 249 0.612829 118 4140
"""


def model(folder, cameras=CAMERAS, images=IMAGES, points=POINTS):
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in (("cameras", cameras), ("images", images), ("points3D", points)):
        if text is not None:
            (folder / f"{name}.txt").write_bytes(text if isinstance(text, bytes) else text.encode())
    return folder


def packed_image(number, pose, camera, name, points=3):
    head = struct.pack("<I7dI", number, *pose, camera) + name + b"\0"
    return head + struct.pack("<Q", points) + struct.pack("<2dq", 1.0, 2.0, -1) * points


POSE = (0.851773, 0.0165051, 0.503764, -0.142941, -0.737434, 1.02973, 3.74354)
BINARY = {
    "cameras.bin": struct.pack("<Q", 2)
    + struct.pack("<IiQQ3d", 1, 0, 3072, 2304, 2559.81, 1536, 1152)
    + struct.pack("<IiQQ4d", 2, 1, 3072, 2304, 2560.56, 2560.56, 1536, 1152),
    "images.bin": struct.pack("<Q", 2)
    + packed_image(1, POSE, 1, b"P1180141.JPG")
    + packed_image(2, POSE, 2, b"sub/P1180142.JPG", 0),
    "points3D.bin": struct.pack("<Q", 2)
    + struct.pack("<Q3d3BdQ2I", 63390, 1.67241, 0.292931, 0.609726, 115, 121, 122, 1.3, 1, 16, 6542)
    + struct.pack("<Q3d3BdQ", 63376, 2.01848, 0.108877, -0.0260841, 102, 209, 250, 1.7, 0),
}


def binary_model(folder, **changes):
    for name, data in (BINARY | {f"{name}.bin": data for name, data in changes.items()}).items():
        (folder / name).write_bytes(data)
    return folder


def check_cameras(found, photographs):
    assert [camera.name for camera in found.cameras] == ["P1180141.JPG", "sub/P1180142.JPG"]
    assert [camera.size for camera in found.cameras] == [(3072, 2304)] * 2
    assert [camera.image for camera in found.cameras] == [
        str(photographs / camera.name) for camera in found.cameras
    ]
    assert all(camera.camera.lens is None for camera in found.cameras)
    # By hand: R of the quaternion, t, and the focal length; COLMAP's pixels have their corners
    # at whole numbers.
    w, x, y, z = np.array(POSE[:4]) / np.linalg.norm(POSE[:4])
    axis = np.array([x, y, z])
    point = np.array([0.3, -0.2, 4.0])
    turned = point + 2 * np.cross(axis, np.cross(axis, point) + w * point)
    seen = turned + np.array(POSE[4:])
    for camera, focal in zip(found.cameras, (2559.81, 2560.56), strict=True):
        place = camera.camera.project(point, camera.size)
        column, row = seen[:2] / seen[2] * focal + (1536, 1152)
        assert (place.column + 0.5, place.row + 0.5) == pytest.approx((column, row), abs=1e-8)
    assert found.points.shape[1] == 3 and found.points.dtype == np.float64
    assert found.points[0].tolist() == [1.67241, 0.292931, 0.609726]
    assert found.point_colors[:2].tolist() == [[115, 121, 122], [102, 209, 250]]
    assert found.point_colors.dtype == np.uint8


@pytest.mark.parametrize("given", ["", "images.txt", "cameras.txt", "points3D.txt"])
def test_a_text_model_as_the_documentation_prints_it(tmp_path, given):
    (tmp_path / "images").mkdir()
    folder = model(tmp_path / "sparse" / "0")
    (folder / "rigs.txt").write_text("# of newer versions\n")
    found = read_cameras(folder / given)
    assert found.format == "colmap" and len(found.points) == 3
    check_cameras(found, tmp_path / "images")


@pytest.mark.parametrize("given", ["", "sparse", "sparse/0", "sparse/0/images.bin"])
def test_a_binary_model_and_where_it_is_looked_for(tmp_path, given):
    folder = model(tmp_path / "sparse" / "0", images="broken")  # binary files go first
    (tmp_path / "images").mkdir()
    found = read_cameras(binary_model(folder) and tmp_path / given)
    assert found.taken[0].startswith("the .bin files in ")
    check_cameras(found, tmp_path / "images")


def test_without_points_or_photographs(tmp_path):
    found = read_cameras(model(tmp_path / "a" / "b" / "c" / "d", points=None))
    assert found.points is None and found.point_colors is None
    assert [camera.image for camera in found.cameras] == ["", ""]
    empty = read_cameras(model(tmp_path / "e", points="# Number of points: 0\n"))
    assert empty.points.shape == (0, 3) and empty.point_colors.shape == (0, 3)


def test_a_last_empty_line_may_be_missing_and_lines_may_end_in_any_way(tmp_path):
    text = "\ufeff" + IMAGES.rstrip("\n")
    for name, images in (("a", text), ("b", text.replace("\n", "\r\n"))):
        points = "\ufeff" + POINTS.replace("\n", "\r\n")
        found = read_cameras(model(tmp_path / name, images=images, points=points))
        assert len(found.cameras) == 2 and len(found.points) == 3


@pytest.mark.parametrize("name", ["../../secret.png", "/etc/a.png", "C:\\a.png", "a/../../b.png"])
def test_a_photograph_is_never_looked_for_outside_of_its_folder(tmp_path, name):
    (tmp_path / "images").mkdir()
    found = read_cameras(model(tmp_path / "m", images=IMAGES.replace("P1180141.JPG", name)))
    assert (found.cameras[0].name, found.cameras[0].image) == (name, "")


def test_a_model_is_only_read():
    with pytest.raises(LucidaError, match="'colmap' is only read; give one of view, opengl,"):
        written([PosedCamera(Camera(), (64, 48))], "colmap")


def test_known_poses_have_no_points(tmp_path: Path) -> None:
    (tmp_path / "cameras.txt").write_text("1 PINHOLE 6 4 5 5 3 2\n")
    (tmp_path / "images.txt").write_text("1 1 0 0 0 0 0 4 1 a.png\n\n")
    (tmp_path / "points3D.txt").touch()  # as COLMAP's guide tells for known poses
    found = read_cameras(tmp_path)
    assert found.points is None and len(found.cameras) == 1
