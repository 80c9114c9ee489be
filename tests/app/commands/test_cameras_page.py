"""docs/cameras.md: its commands run, on files as the others' documentation prints them; its Python
runs; its table names every format; its formulas are the camera's."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import numpy as np
import pytest

from lucida import load_view
from lucida.app.cli import main

PAGE = (Path(__file__).parents[3] / "docs" / "cameras.md").read_text("utf-8")

# NeRF: nerfstudio's "Data conventions".
TRANSFORMS = """\
{
  "camera_model": "OPENCV",
  "fl_x": 525.0, "fl_y": 525.0, "cx": 320.0, "cy": 240.0, "w": 640, "h": 480,
  "k1": 0.0, "k2": 0.0, "p1": 0.0, "p2": 0.0,
  "frames": [
    {"file_path": "images/frame_00001.jpeg",
     "transform_matrix": [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 1.0, 8.0],
                          [0.0, 0.0, 0.0, 1.0]]},
    {"file_path": "images/frame_00002.jpeg",
     "transform_matrix": [[0.0, 0.0, 1.0, 8.0], [0.0, 1.0, 0.0, 1.0], [-1.0, 0.0, 0.0, 0.0],
                          [0.0, 0.0, 0.0, 1.0]]}
  ]
}
"""

# OpenCV: cv::FileStorage's own layout.
CALIBRATION = """\
%YAML:1.0
---
image_width: 640
image_height: 480
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.2500000000000000e+02, 0., 3.1950000000000000e+02, 0.,
       5.2500000000000000e+02, 2.3950000000000000e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ 0., 0., 0., 0., 0. ]
"""

# COLMAP: "Output format".
SPARSE = {
    "cameras.txt": "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
    "1 PINHOLE 640 480 525 525 320 240\n",
    "images.txt": "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
    "1 0 1 0 0 0 1 8 1 IMG_7.jpg\n\n2 0 0.7071068 0 0.7071068 0 1 8 1 IMG_8.jpg\n\n",
    "points3D.txt": "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[]\n",
}


@pytest.fixture(autouse=True)
def in_a_folder_of_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("transforms.json").write_text(TRANSFORMS)
    Path("calibration.yml").write_text(CALIBRATION)
    Path("sparse/0").mkdir(parents=True)
    for name, text in SPARSE.items():
        Path("sparse/0", name).write_text(text)


def commands() -> list[str]:
    found = re.findall(r"^    (lucida .*)$", PAGE, re.MULTILINE)
    return [re.split(r"\s{2,}", line)[0] for line in found]


def test_the_commands_run_one_after_the_other(capsys, gl_backend):
    outs = {}
    for line in commands():
        words = shlex.split(line)[1:]
        if words[0] in ("render", "compare"):
            words += ["--backend", gl_backend]
        assert main(words) == 0, line
        outs[line], err = capsys.readouterr()
        assert err == "", line
    assert "cameras    2: " in outs["lucida camera transforms.json"]
    assert "eye         (8, 1, 0)" in outs["lucida camera transforms.json#1"]
    told = outs["lucida camera calibration.yml"]
    assert "K           (525, 0, 319.5), (0, 525, 239.5), (0, 0, 1)" in told
    assert "seen.png: color, raster, 640x480" in outs[next(o for o in outs if "render" in o)]
    left, right, bottom, top = load_view("corner.toml").camera.viewport  # by --pixel-origin corner
    assert np.allclose(
        [left, right, bottom, top],
        [-319.5 / 525, 320.5 / 525, -240.5 / 525, 239.5 / 525],
        rtol=0,
        atol=1e-12,
    )
    written = Path("centred.yml").read_text().split("camera_matrix")[1]
    K = np.array(re.search(r"data: \[([^]]*)\]", written)[1].split(","), float).reshape(3, 3)
    assert np.allclose(K, [[525, 0, 319], [0, 525, 239], [0, 0, 1]], rtol=0, atol=1e-9)


def test_the_page_s_python_runs_and_comes_back_to_the_same_camera():
    block = re.search(r"## From Python\n\n((?:    .*\n|\n)+)", PAGE)
    names: dict = {}
    exec(re.sub("^    ", "", block[1], flags=re.MULTILINE), names)
    seen = names["camera"].project((1.0, 1.0, 0.0), names["size"])
    assert (names["x"], names["y"]) == pytest.approx((seen.column, seen.row), abs=1e-9)
    for field in ("eye", "u", "v", "w"):
        there, back = getattr(names["camera"], field), getattr(names["same"], field)
        assert np.allclose(there, back, rtol=0, atol=1e-12)
    assert (names["first"].size, names["found"].format) == ((640, 480), "nerf")
