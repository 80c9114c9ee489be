"""OpenCV's and ROS's calibration files: as their documentation prints them, there and back."""

from __future__ import annotations

import json

import numpy as np
import pytest
from format_cameras import assert_same_pixels, pasted

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.cameras.distortion import NAMES
from lucida.renderer.files.cameras.given import Options
from lucida.renderer.files.cameras.opencv_keys import lens_table
from lucida.renderer.files.cameras.rotations import from_vector
from lucida.renderer.system.errors import LucidaError

# As OpenCV's calibration sample writes it.
SAMPLE = """%YAML:1.0
---
calibration_time: "Sat Nov 21 10:12:14 2026"
nr_of_frames: 2
image_width: 640
image_height: 480
board_width: 9
square_size: 2.5000000000000000e+01
flags: 0
fisheye_model: 0
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.3281002689700858e+02, 0., 3.4249525075433394e+02, 0.,
       5.3294854491841830e+02, 2.3389915300294615e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -2.8088364677185440e-01, 2.5130640203085970e-02,
       1.2152390660364360e-03, -1.3551580437263890e-04,
       1.6345430660394970e-01 ]
avg_reprojection_error: 1.9582819477190540e-01
extrinsic_parameters: !!opencv-matrix
   rows: 2
   cols: 6
   dt: d
   data: [ 1.7e-01, 2.8e-01, 1.0e-02, -7.5e+01, -1.0e+02, 4.0e+02,
       4.1e-01, 6.5e-01, -1.3e+00, -5.9e+01, 8.4e+01, 3.6e+02 ]
"""
# As ROS's camera_calibration_parsers has it.
ROS = """image_width: 640
image_height: 480
camera_name: narrow_stereo
camera_matrix:
  rows: 3
  cols: 3
  data: [438.783367, 0.000000, 305.593336, 0.000000, 437.302876, 243.738352, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.361976, 0.110510, 1e-05, 0.000505, 0.000000]
rectification_matrix:
  rows: 3
  cols: 3
  data: [0.999978, 0.002789, -0.006046, -0.002816, 0.999986, -0.004401, 0.00603, 0.0044, 0.99997]
projection_matrix:
  rows: 3
  cols: 4
  data: [393.653800, 0, 322.797939, 0, 0, 393.6538, 241.090902, 0, 0, 0, 1, 0]
"""
XML = """<?xml version="1.0"?>
<opencv_storage>
<!-- a comment -->
<image_width>640</image_width>
<image_height>480</image_height>
<camera_matrix type_id="opencv-matrix">
  <rows>3</rows>
  <cols>3</cols>
  <dt>d</dt>
  <data>
    800. 0. 320. 0. 810.
    240. 0. 0. 1.</data></camera_matrix>
<rvec>0.1 0.2 0.3</rvec>
<tvec>1. 2. 3.</tvec>
</opencv_storage>
"""
K = [[800.0, 0.0, 320.0], [0.0, 810.0, 240.0], [0.0, 0.0, 1.0]]
NAMED = {"K": K, "image_size": [640, 480]}
POSE = [[0.6, 0.0, 0.8, 1.0], [0.0, 1.0, 0.0, 2.0], [-0.8, 0.0, 0.6, 3.0], [0.0, 0.0, 0.0, 1.0]]
AT_POSE = Camera.from_intrinsics(K, size=(640, 480), camera_from_world=POSE)


@pytest.mark.parametrize("angle", [0.0, 1e-9, 0.5, 3.0, np.pi - 1e-9, np.pi])
def test_a_rotation_vector_turns_about_itself(angle: float) -> None:
    for axis in np.random.default_rng(3).normal(size=(20, 3)):
        vector = angle * axis / np.linalg.norm(axis)
        rotation = from_vector(vector)
        assert rotation @ rotation.T == pytest.approx(np.eye(3))
        assert rotation @ vector == pytest.approx(vector)


def test_a_vector_turns_by_the_right_hand() -> None:
    assert from_vector(np.array([0, 0, np.pi / 2])) @ (1, 0, 0) == pytest.approx([0, 1, 0])


def test_opencv_s_sample_holds_a_camera_without_a_pose() -> None:
    (first,) = (found := pasted(SAMPLE)).cameras
    assert first.size == (640, 480)
    lens = first.camera.lens
    assert lens is not None and list(lens.coefficients) == ["k1", "k2", "k3", "p1", "p2"]
    K = first.camera.intrinsics((640, 480)).K
    assert K[:2].ravel() == pytest.approx(
        [532.81002689700858, 0, 342.49525075433394, 0, 532.9485449184183, 233.89915300294615]
    )
    assert "extrinsic_parameters" in found.notes[0]


def test_ros_s_rectified_image_is_not_used_and_named() -> None:
    (camera,) = (found := pasted(ROS)).cameras
    assert (camera.name, camera.size) == ("narrow_stereo", (640, 480))
    K, R, t = camera.camera.intrinsics((640, 480))
    assert (K[0, 0], K[1, 2]) == pytest.approx((438.783367, 243.738352))
    assert pytest.approx(np.eye(3)) == R and not t.any()
    assert camera.camera.lens is not None and camera.camera.lens.coefficient("p1") == 1e-05
    assert "no pose: the camera is at the origin" in found.taken
    assert {"not used: projection_matrix", "not used: rectification_matrix"} <= {*found.notes}


@pytest.mark.parametrize(
    "text",
    [
        "%YAML 1.2\n---\nK: [800, 810, 320, 240]\ntvec: !!opencv-nd-matrix\n   sizes: [ 3 ]\n"
        "   dt: d\n   data: [ 1., 2., 3. ]\n",
        '{"K": [800, 810, 320, 240], "tvec": {"type_id": "opencv-nd-matrix", "sizes": [3], '
        '"dt": "d", "data": [1, 2, 3]}}',
        XML.replace(
            "<tvec>1. 2. 3.</tvec>",
            '<tvec type_id="opencv-nd-matrix"><sizes>\n 3</sizes><data>1. 2. 3.</data></tvec>',
        ),
    ],
    ids=["yaml", "json", "xml"],
)
def test_a_vector_that_opencv_5_wrote(text: str) -> None:
    (camera,) = pasted(text).cameras
    assert camera.camera.intrinsics((640, 480)).t == pytest.approx([1, 2, 3])


def test_opencv_s_xml_is_read_with_its_pose() -> None:
    (camera,) = pasted(XML).cameras
    pose = np.column_stack([from_vector(np.array([0.1, 0.2, 0.3])), (1, 2, 3)])
    wanted = Camera.from_intrinsics(K, size=(640, 480), camera_from_world=pose)
    assert_same_pixels(wanted, camera.camera, (640, 480))


@pytest.mark.parametrize(
    "table",
    [
        NAMED | {"R": [row[:3] for row in POSE[:3]], "t": [1, 2, 3]},
        NAMED | {"R": [row[:3] for row in POSE[:3]], "T": [[1], [2], [3]]},
        NAMED | {"rvec": [0, np.arctan2(0.8, 0.6), 0], "tvec": [[1, 2, 3]]},
        NAMED | {"extrinsics": POSE},
        NAMED | {"cam2world": np.linalg.inv(POSE).tolist()},
        {"intrinsic": [800, 810, 320, 240], "resolution": [640, 480], "extrinsic": POSE},
        {"fx": 800, "fy": 810, "cx": 320, "cy": 240, "w": 640, "h": 480, "extrinsic": POSE},
        {"P": (np.array(K) @ POSE[:3]).tolist(), "size": [640, 480]},
    ],
    ids=lambda table: "-".join(table),
)
def test_the_names_that_people_use(table: dict) -> None:
    found = pasted(json.dumps(table))
    assert found.format == "opencv" and found.cameras[0].camera.lens is None
    assert_same_pixels(AT_POSE, found.cameras[0].camera, (640, 480))
    assert found.cameras[0].size == (640, 480)


@pytest.mark.parametrize(
    "text",
    [
        "K =\n{k}\nR =\n{r}\nt = {t}\nimage_size = 640, 480",
        "K = [800 0 320; 0 810 240; 0 0 1];\nRt = [.6 0 .8 1; 0 1 0 2; -.8 0 .6 3];\nsize=640x480",
        "# mine\nK=[[800,0,320],[0,810,240],[0,0,1]]; R={rows}; t=[1,2,3]\nw = 640\nh = 480 # px",
        "K = torch.tensor([[800., 0., 320.],\n [0., 810., 240.], [0., 0., 1.]], dtype=float)\n"
        "extrinsics = np.array(np.array({pose}, dtype=float), )\nw = int(640)\nh = 480",
        "{{'K': {klist}, 'R': {rows}, 't': (1, 2, 3), 'size': (640, 480)}}",
    ],
)
def test_what_is_pasted_as_it_is_printed(text: str) -> None:
    pose = np.array(POSE)
    text = text.format(
        k=np.array(K), r=pose[:3, :3], t=pose[:3, 3], rows=pose[:3, :3].tolist(), pose=POSE, klist=K
    )
    found = pasted(text)
    assert found.format == "opencv"
    assert_same_pixels(AT_POSE, found.cameras[0].camera, (640, 480))


LENGTHS = {"k1": 5, "k3": 5, "k4": 8, "k6": 8, "s1": 12}  # by the last coefficient


@pytest.mark.parametrize(("last", "length"), LENGTHS.items())
def test_a_lens_is_written_with_a_length_that_opencv_takes(last: str, length: int) -> None:
    table = lens_table(Lens("brown", {last: 0.01}))
    written = np.asarray(table["distortion_coefficients"]).ravel()
    assert len(written) == length and written[NAMES.index(last)] == 0.01
    assert np.count_nonzero(written) == 1


def test_a_size_that_is_not_given_is_told() -> None:
    text = json.dumps({"K": K, "extrinsics": POSE})
    found = pasted(text)
    assert found.cameras[0].size == (641, 481)
    assert any("no image size is given: 641 x 481" in phrase for phrase in found.taken)
    assert pasted(text, options=Options(size=(640, 480))).cameras[0].size == (640, 480)
    assert pasted(text, options=Options(pixel_origin="corner")).cameras[0].size == (640, 480)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"K": K[:2]}, "K: has 6 numbers; give 9 or 4"),
        ({"K": np.transpose(K).tolist()}, "K: its rows"),
        ({"K": {"sizes": [9], "data": [1, 2]}}, "K: has 2 numbers; give 9 or 4"),
        ({"image_size": [640.5, 480]}, "image_size: 640.5 is not a count of pixels"),
        ({"extrinsics": np.transpose(POSE).tolist()}, "extrinsics: its last row.*transposed"),
        ({"D": [0.1, 0.2]}, "D: has 2 numbers; give 4 or 5 or 8"),
    ],
)
def test_what_is_broken_is_told_in_one_line(change: dict, told: str) -> None:
    with pytest.raises(LucidaError, match=told) as caught:
        pasted(json.dumps(NAMED | change), "opencv")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (SAMPLE.replace("3.4249525075433394e+02, 0.,", "3.42e+02,"), "has 8 numbers; give 9 or 4"),
        (SAMPLE.replace("image_width: 640\n", ""), "image_width: is missing"),
        (SAMPLE.replace("!!opencv-matrix", "!!python/object:os.system"), "could not determine"),
        ("%YAML:1.0\n---\nK: " + "[" * 3000, "nested too deeply"),
        (XML.replace("<opencv_storage>", "<!DOCTYPE a><opencv_storage>"), "declaration"),
        ("K = np.array([[1, 2, 3]]).T", "K: continues with '.T' after its numbers"),
        ("K = [[1, 2, ...], [1]]", "K: continues with '...'"),
        ("K = [[1, 2, 3", "K: has a bracket that is not closed"),
        ("K = [[1, 2, nan], [0, 1, 1], [0, 0, 1]]", "K: has a number that is not finite"),
        ("K = [800 0 -20; 0 800 20; 0 0 1]", "image_width: is missing"),
    ],
    ids=lambda value: value[:30],
)
def test_broken_texts_are_told_in_one_line(text: str, told: str) -> None:
    with pytest.raises(LucidaError, match=told) as caught:
        pasted(text, "opencv")
    assert "\n" not in str(caught.value)


def test_a_matrix_without_a_name_is_not_passed_over() -> None:
    K = "K = [[20, 0, 8], [0, 20, 6], [0, 0, 1]]\n"
    assert pasted(K).format == "opencv"
    for pose in ("[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 4]]", "np.array([[1, 0, 0, 0]])"):
        with pytest.raises(LucidaError, match=r"K: has \d+ numbers"):
            pasted(K + pose)
