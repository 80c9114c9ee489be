"""Files as others write them: no lens under another name, no skew is passed over."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from format_cameras import pasted

from lucida.renderer.files.cameras import read_cameras
from lucida.renderer.system.errors import LucidaError

FOCAL = "fx: 500\nfy: 500\ncx: 320\ncy: 240\nwidth: 640\nheight: 480\n"
# As ROS prints a message: with tables within the table, and lists of a number a line.
ECHO = """header:
  stamp:
    sec: 1
  frame_id: camera
height: 480
width: 640
distortion_model: plumb_bob
d:
- 0.0
- 0.0
- 0.0
- 0.0
- 0.0
k:
- 655.5
- 0.0
- 319.5
- 0.0
- 655.5
- 239.5
- 0.0
- 0.0
- 1.0
roi:
  x_offset: 0
  y_offset: 0
  height: 0
  width: 0
  do_rectify: false
---
"""


@pytest.mark.parametrize(
    "text", [FOCAL + "k1: 0.3\nk2: 0.1\n", FOCAL + "p2: 0.01\n", FOCAL + "distCoef: [0, 0, 0, 0.1]"]
)
def test_coefficients_are_a_lens(text: str) -> None:
    assert pasted(text).cameras[0].camera.lens is not None


def test_a_name_with_spaces_is_read() -> None:
    text = "Camera matrix : \n\n[[500 0 320]\n [0 500 240]\n [0 0 1]]\ndistortion coefficients: "
    assert pasted(text + "[[0. 0. 0. 0.]]").format == "opencv"
    lens = pasted(text + "[[0.3 0. 0. 0.]]").cameras[0].camera.lens
    assert lens is not None and dict(lens.coefficients) == {"k1": 0.3}


@pytest.mark.parametrize(
    "text",
    [
        FOCAL + "k1: 0.0\ndistance: 5\nundistorted: true\ndist_type: none\n",
        FOCAL + "distortion_model: radial-tangential\ndistortion_coefficients: [0, 0, 0, 0]\n",
    ],
)
def test_what_is_no_lens_is_a_pinhole(text: str) -> None:
    assert pasted(text).cameras[0].camera.lens is None


def test_a_skew_beside_the_focal_lengths_is_held() -> None:
    found = pasted(FOCAL + "skew: 30\n").cameras[0]
    assert found.camera.intrinsics((640, 480))[0][0, 1] == pytest.approx(30)
    bent = FOCAL + "skew: 30\nk1: 0.1\n"
    with pytest.raises(LucidaError, match=r"fx: has the skew 30 of a lens.*; calibrate without"):
        pasted(bent)


def test_a_message_of_ros_is_read_as_it_is_printed(tmp_path: Path) -> None:
    (tmp_path / "echo.txt").write_text(ECHO)
    found = read_cameras(tmp_path / "echo.txt").cameras[0]
    assert found.size == (640, 480)
    made = found.camera.intrinsics((640, 480))[0]
    np.testing.assert_allclose(made, np.array([[655.5, 0, 319.5], [0, 655.5, 239.5], [0, 0, 1]]))


def test_a_page_is_no_view_file_though_it_holds_one(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text("<pre>\n[camera]\n</pre>")
    with pytest.raises(LucidaError, match="is not a recognised camera format"):
        read_cameras(tmp_path / "a.html")
