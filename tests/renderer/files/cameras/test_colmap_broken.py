"""Models of COLMAP that are broken: one line each, naming file, line or entry, and remedy."""

from __future__ import annotations

import struct

import pytest
from test_colmap import BINARY, CAMERAS, IMAGES, POINTS, binary_model, model

from lucida.renderer.files.cameras import read_cameras
from lucida.renderer.system.errors import LucidaError


def said(folder) -> str:
    with pytest.raises(LucidaError) as raised:
        read_cameras(folder, "colmap")
    error = raised.value
    assert error.remedy and "\n" not in str(error)
    return str(error).removeprefix(str(folder) + "/")


def changed(text, old, new):
    assert old in text
    return text.replace(old, new, 1)


TEXT = [
    ("cameras", (CAMERAS, "2559.81", "1e300"), "line 4: f: 1e+300 is too large; "),
    (
        "cameras",
        (CAMERAS, "SIMPLE_PINHOLE", "PINHOLY"),
        "line 4: MODEL: 'PINHOLY' is a lens that",
    ),
    ("cameras", (CAMERAS, " 2559.81", ""), "line 4: PARAMS: SIMPLE_PINHOLE has 3 parameters, not"),
    ("cameras", (CAMERAS, "2559.81", "2,5"), "line 4: '1 SIMPLE_PINHOLE 3072 2304 2,5"),
    (
        "images",
        (IMAGES, "0.851773 0.0165051 0.503764 -0.142941", "0 0 0 0"),
        "quaternion: (0, 0, 0, 0)",
    ),
    ("images", (IMAGES, " 1 P118", " 9 P118"), "line 5: CAMERA_ID: 9 is not in cameras.txt; "),
    ("images", (IMAGES, " P1180141.JPG", ""), "line 5: '1 0.851773 0.0165051"),
    ("images", (IMAGES, "2362.39 248.498 58396 ", "2362.39 "), "line 6: '2362.39 "),
    ("points3D", (POINTS, "1.67241", "x"), "holds a point that is not within"),
]


@pytest.mark.parametrize(("name", "change", "expected"), TEXT)
def test_a_broken_text_names_file_line_and_value(tmp_path, name, change, expected):
    folder = model(tmp_path, **{name.replace("points3D", "points"): changed(*change)})
    assert said(folder).startswith(f"{name}.txt: {expected}")


def test_poses_without_an_empty_line_between_them(tmp_path):
    pose = "1 1 0 0 0 0 0 0 1 a.jpg\n2 1 0 0 0 0 0 0 1 b.jpg\n"
    assert said(model(tmp_path, images=pose)).startswith(
        "images.txt: line 2: '2 1 0 0 0 0 0 0 1 b.jpg' is not X Y POINT3D_ID again and again"
    )


@pytest.mark.parametrize("below", ["", "sparse/0"])
def test_a_model_that_lacks_its_images(tmp_path, below):
    (model(tmp_path / below) / "images.txt").unlink()
    with pytest.raises(LucidaError, match=r"images\.txt: does not exist"):
        read_cameras(tmp_path)


def test_a_folder_without_a_model(tmp_path):
    with pytest.raises(LucidaError, match="has no cameras and images of COLMAP"):
        read_cameras(tmp_path, "colmap")
    with pytest.raises(LucidaError, match="holds no camera"):
        read_cameras(model(tmp_path, images="# none\n"))


BINARY_CASES = [
    ("cameras", lambda data: data[:-3], "camera 2 of 2: the file ends within it, at "),
    (
        "cameras",
        lambda data: b"\xff" * 8 + data[8:],
        "camera 3 of 18446744073709551615: the file e",
    ),
    (
        "cameras",
        lambda data: data[:32] + struct.pack("<d", float("nan")) + data[40:],
        "camera 1 of 2: f: nan is not finite; ",
    ),
    ("images", lambda data: data.replace(b"\0P", b"\0\0", 1), "image 1 of 2: "),
    ("points3D", lambda data: data[:-1], "point 2 of 2: the file ends within it, at "),
    ("points3D", lambda data: b"\xff" * 8 + data[8:], "point 3 of 18446744073709551615: "),
]


@pytest.mark.parametrize(("name", "change", "expected"), BINARY_CASES)
def test_a_broken_binary_names_file_and_value(tmp_path, name, change, expected):
    folder = binary_model(tmp_path, **{name: change(BINARY[f"{name}.bin"])})
    assert said(folder).startswith(f"{name}.bin: {expected}")


def test_every_truncation_of_a_binary_model_is_an_error(tmp_path):
    binary_model(tmp_path)
    for name, data in BINARY.items():
        for length in range(len(data)):
            (tmp_path / name).write_bytes(data[:length])
            assert said(tmp_path).startswith(name)
        (tmp_path / name).write_bytes(data)
