"""The description of a file of cameras: each quantity, in the lecture's words and as data."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from lucida import Camera
from lucida.app.cameras.described import as_data, as_text, facts
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.cameras import CameraSet, PosedCamera

PLAIN = Camera(viewport=(-2 / 3, 2 / 3, -0.5, 0.5))
SIZE = (64, 48)


def told(camera: Camera, size: tuple[int, int] | None = SIZE, **named) -> dict[str, str]:
    posed = PosedCamera(camera, size, **named)
    return dict(facts(CameraSet("view", (posed,)), posed))


def of_set(*cameras: PosedCamera, **named) -> dict[str, str]:
    return dict(facts(CameraSet("view", cameras, **named)))


def lens(k1: float = -0.2, **coefficients: float) -> Lens:
    return Lens("brown", {"k1": k1, **coefficients})


class TestOne:
    def test_every_value_of_a_plain_camera(self):
        across = 2 * math.degrees(math.atan(2 / 3))
        up = 2 * math.degrees(math.atan(0.5))
        assert told(PLAIN) == {
            "format": "view: Lucida's view file",
            "size": "64x48",
            "eye": "(0, 0, 0)",
            "u": "(1, 0, 0)",
            "v": "(0, 1, 0)",
            "w": "(0, 0, 1)",
            "distance": "1",
            "viewport": "(-0.6666667, 0.6666667, -0.5, 0.5)",
            "projection": "perspective",
            "fov_deg": f"({across:.7g}, {up:.7g})",
            "basis": "orthonormal, right-handed",
            "K": "(48, 0, 31.5), (0, 48, 23.5), (0, 0, 1)",
            "R": "(1, 0, 0), (0, -1, 0), (0, 0, -1)",
            "t": "(0, 0, 0)",
            "": "K, R and t count pixels from the centre of the first one",
        }

    def test_names_and_conventions_come_first(self):
        posed = PosedCamera(PLAIN, SIZE, "left\n7", "images/left.png")
        found = facts(CameraSet("view", (posed,), ("y up", "rows")), posed)
        assert [tuple(fact) for fact in found[:5]] == [
            ("format", "view: Lucida's view file"),
            ("taken", "y up"),
            ("", "rows"),
            ("name", "left 7"),
            ("image", "images/left.png"),
        ]

    def test_without_a_size_there_are_no_pixels(self):
        found = told(PLAIN, None)
        assert found["size"] == "of any size" and "K" not in found

    def test_a_parallel_camera_has_no_angles(self):
        camera = Camera(u=(2, 0, 0), v=(0, 3, 0), projection="parallel", near=0.5, far=9.0)
        found = told(camera, (60, 40))
        assert (found["near"], found["far"]) == ("0.5", "9")
        assert {"fov_deg", "K"}.isdisjoint(found)

    @pytest.mark.parametrize(
        ("fields", "said"),
        [
            ({"u": (-1, 0, 0)}, "orthonormal, left-handed: the picture is mirrored"),
            ({"v": (0, 2, 0)}, "lengths (1, 2, 1), angles uv, vw, wu (90, 90, 90) degrees, "
             "right-handed"),
            ({"v": (1, 1, 0)}, "lengths (1, 1.414214, 1), angles uv, vw, wu (45, 90, 90) degrees, "
             "right-handed"),
            ({"u": (1.000001, 0, 0)}, "orthonormal, right-handed"),
        ],
    )  # fmt: skip
    def test_a_basis_says_what_it_is(self, fields, said):
        assert told(Camera(**fields))["basis"] == said

    def test_what_products_leave_is_no_number(self):
        assert told(replace(PLAIN, eye=(-1e-15, 2, -0.0)))["eye"] == "(0, 2, 0)"
        assert told(replace(PLAIN, eye=(1e-13, 2, 0)))["eye"] == "(1e-13, 2, 0)"


class TestLens:
    def test_it_is_named_with_its_coefficients(self):
        bent = replace(PLAIN, lens=lens(k2=0.0))
        assert told(bent)["lens"] == "brown, k1 = -0.2, k2 = 0"
        told_data = as_data(CameraSet("view", (PosedCamera(bent, SIZE),)))["cameras"][0]
        assert told_data["lens"] == {"model": "brown", "k1": -0.2, "k2": 0}
        assert "lens" not in told(PLAIN)

    def test_of_several_the_first_is_told(self):
        cameras = [PosedCamera(replace(PLAIN, lens=lens(k)), SIZE) for k in (0.1, 0.3)]
        said = of_set(PosedCamera(PLAIN, SIZE, "c"), *cameras)["lens"]
        assert said == "brown, k1 = 0.1, the first of 2"


class TestSet:
    def test_a_set_is_described_with_its_names_and_points(self):
        eyes = ((0, 1, 6), (6, -1, 0))
        cameras = [
            PosedCamera(replace(PLAIN, eye=eye), SIZE, f"{i}.png") for i, eye in enumerate(eyes)
        ]
        points = np.zeros((5, 3))
        assert of_set(*cameras, taken=("y up",), points=points) == {
            "format": "view: Lucida's view file",
            "taken": "y up",
            "cameras": "2: 0.png, 1.png",
            "size": "64x48",
            "points": "5 of a reconstruction",
        }
        assert "points" not in of_set(*cameras, points=np.zeros((0, 3)))


def test_text_has_two_columns():
    text = as_text(facts(CameraSet("view", (PosedCamera(PLAIN),) * 2)))
    assert text.splitlines()[:2] == ["format   view: Lucida's view file", "cameras  2"]


class TestData:
    def test_a_camera_as_values(self):
        camera = replace(PLAIN, near=0.5)
        posed = PosedCamera(camera, SIZE, "a", "a.png")
        data = as_data(CameraSet("view", (posed, posed), ("y up",), np.zeros((2, 3))), posed)
        assert (data["format"], data["taken"], data["points"]) == ("view", ["y up"], 2)
        (found,) = data["cameras"]
        K, R, t = camera.intrinsics(SIZE)
        assert found.pop("fov_deg") == [camera.fov_x_deg, camera.fov_y_deg]
        assert found == {
            "name": "a",
            "image": "a.png",
            "size": [64, 48],
            "eye": [0, 0, 0],
            "u": [1, 0, 0],
            "v": [0, 1, 0],
            "w": [0, 0, 1],
            "distance": 1,
            "viewport": list(PLAIN.viewport),
            "fit": False,
            "projection": "perspective",
            "near": 0.5,
            "far": None,
            "basis": "orthonormal, right-handed",
            "K": K.tolist(),
            "R": R.tolist(),
            "t": t.tolist(),
            "lens": None,
        }
