"""three.js's cameras, there and back: as its documentation prints them, random and broken ones."""

from __future__ import annotations

import copy
import json
import math

import numpy as np
import pytest
from format_cameras import (
    farthest_px,
    pasted,
    straight_camera,
)

from renderer.camera_formats import PosedCamera, written
from renderer.errors import LucidaError

# What camera.toJSON() gives of a PerspectiveCamera(50, 1.5) at (1, 2, 3).
DOCUMENTED = {
    "metadata": {"version": 4.7, "type": "Object", "generator": "Object3D.toJSON"},
    "object": {
        "uuid": "7cb9b4c9-2e3d-4c3b-9a39-0d6b8a1f3d57",
        "type": "PerspectiveCamera",
        "name": "main",
        "layers": 1,
        "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1],
        "up": [0, 1, 0],
        "fov": 50,
        "zoom": 1,
        "near": 0.1,
        "far": 2000,
        "focus": 10,
        "aspect": 1.5,
        "filmGauge": 35,
        "filmOffset": 0,
    },
}
ORTHOGRAPHIC = {
    "type": "OrthographicCamera",
    "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    "zoom": 2,
    "left": -1,
    "right": 3,
    "top": 2,
    "bottom": -2,
    "near": 0.5,
    "far": 9,
}


def changed(**fields):
    file = copy.deepcopy(DOCUMENTED)
    file["object"].update(fields)
    return json.dumps(file)


def test_a_camera_as_the_documentation_prints_it():
    found = pasted(json.dumps(DOCUMENTED))
    (posed,) = found.cameras
    assert (found.format, posed.name, posed.size, posed.fit) == ("three", "main", None, True)
    camera = posed.camera
    assert camera.eye == (1, 2, 3) and camera.basis.tolist() == np.eye(3).tolist()
    top = math.tan(math.radians(25))
    assert camera.viewport == pytest.approx((-1.5 * top, 1.5 * top, -top, top))
    assert (camera.near, camera.far, camera.distance) == (0.1, 2000, 1)


def test_every_parameter_of_a_perspective_camera():
    # As PerspectiveCamera.updateProjectionMatrix() has it, at distance 1, step by step by hand.
    view = {"enabled": True, "fullWidth": 400, "fullHeight": 200}
    view |= {"offsetX": 100, "offsetY": 20, "width": 200, "height": 150}
    text = changed(fov=90, aspect=2, zoom=2, filmGauge=30, filmOffset=6, view=view)
    (posed,) = pasted(text).cameras
    # Half height 1/2; the whole is 2 x 1; the part is 1 x 0.75 from (-0.5, 0.4), moved 6 / 30.
    assert posed.camera.viewport == pytest.approx((-0.3, 0.7, -0.35, 0.4))
    assert (posed.size, posed.fit) == ((200, 150), False)
    (off,) = pasted(changed(view=view | {"enabled": False})).cameras
    assert (off.size, off.fit) == (None, True)


def test_an_orthographic_camera():
    (posed,) = pasted(json.dumps({"object": ORTHOGRAPHIC})).cameras
    assert posed.camera.is_parallel
    assert posed.camera.viewport == pytest.approx((0, 2, -1, 1))
    view = {"enabled": True, "fullWidth": 40, "fullHeight": 20}
    view |= {"offsetX": 10, "offsetY": 5, "width": 20, "height": 10}
    (part,) = pasted(json.dumps(ORTHOGRAPHIC | {"view": view})).cameras
    assert part.camera.viewport == pytest.approx((0.5, 1.5, -0.5, 0.5))


def test_what_is_behind_an_orthographic_camera_is_seen_from_farther_back():
    (posed,) = pasted(json.dumps(ORTHOGRAPHIC | {"near": -5})).cameras
    assert posed.camera.eye == (0, 0, 5)
    assert (posed.camera.near, posed.camera.far) == (None, 14)
    assert pasted(json.dumps(ORTHOGRAPHIC | {"near": 0, "far": None})).cameras[0].camera.far is None


def test_cameras_within_a_scene_stand_where_their_parents_put_them():
    moved = [0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 10, 0, 0, 1]  # a quarter turn about y, twice
    child = ORTHOGRAPHIC | {"name": "below"}
    group = {"type": "Group", "matrix": moved, "children": [{"type": "Mesh"}, child]}
    turned = {"type": "PerspectiveCamera", "name": "turned", "position": [1, 2, 3]}
    turned["quaternion"] = [math.sqrt(0.5), 0, 0, math.sqrt(0.5)]  # about x
    scene = {"object": {"type": "Scene", "children": [group, turned]}}
    below, other = pasted(json.dumps(scene)).cameras
    assert (below.name, other.name) == ("below", "turned")
    assert below.camera.eye == (10, 0, 0)
    assert np.allclose(below.camera.basis, [[0, 0, 1], [0, 1, 0], [-1, 0, 0]])
    assert other.camera.eye == (1, 2, 3)
    assert np.allclose(other.camera.basis, [[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    assert other.camera.near is None  # fitted to the scene where the file says nothing


def test_several_cameras_are_children_of_one_group():
    random = np.random.default_rng(4)
    cameras = [
        PosedCamera(straight_camera(random, projection), (64, 48), name)
        for projection, name in (("perspective", "a"), ("parallel", "b"), ("perspective", ""))
    ]
    text = written(cameras, "three")[""]
    assert text == written(cameras, "three")[""]
    uuids = {child["uuid"] for child in json.loads(text)["object"]["children"]}
    assert len(uuids) == 3
    for one, other in zip(cameras, pasted(text).cameras, strict=True):
        assert one.name == other.name
        assert farthest_px(one.camera, other.camera, (64, 48), random) < 1e-8


ROW_MAJOR = [1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1]
VIEW = {"enabled": True, "fullWidth": 0, "fullHeight": 2, "width": 1, "height": 1}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (changed(fov=180), "object.fov: 180 is not below 180; "),
        (changed(fov=0), "object.fov: 0 is not above 0; "),
        (changed(near=0), "object.near: 0 is not above 0; "),
        (changed(near=3, far=2), "object.far: 2 is not above near = 3; "),
        (changed(matrix=[1] * 15), "object.matrix: [1, 1, 1, "),
        (changed(matrix=ROW_MAJOR), "object.matrix: its last row is (5, 6, 7, 1), not (0, 0, 0, 1"),
        (changed(matrix=[0] * 15 + [1]), "object.matrix: has columns of length (0, 0, 0); "),
        (
            changed(matrix=[1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
            "object.matrix: its columns (1, 0, 0), (0.707107, 0.707107, 0), (0, 0, 1) are not at ",
        ),
        (
            changed(matrix=[-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
            "object.matrix: its columns (-1, 0, 0), (0, 1, 0), (0, 0, 1) are left-handed; ",
        ),
        (changed(view=3), "object.view: is no object; "),
        (changed(view=VIEW), "object.view.fullWidth: 0 is not above 0; "),
        (changed(children=7), "object.children: is no list; "),
        (changed(children=[{"children": [4]}]), "object.children[0].children[0]: is no object; "),
        (
            changed(children=[{"quaternion": [0] * 4}]),
            "object.children[0].quaternion: (0, 0, 0, 0)",
        ),
        (changed(children=[{"rotation": [0, 0, 0]}]), "object.children[0].rotation: are angles "),
        (
            changed(children=[{"scale": [1e9] * 3, "children": [{"scale": [1e9] * 3}]}]),
            "object.children[0].children[0].matrix: leads beyond what can be drawn, with those ",
        ),
        (changed(type="Mesh"), "holds no camera (three); "),
        (json.dumps(ORTHOGRAPHIC | {"left": 3}), "object.viewport: "),
        ("[1, 2]", "object: is no object of three.js; "),
    ],
)
def test_broken_files(text, said):
    with pytest.raises(LucidaError) as raised:
        pasted(text, "three")
    assert str(raised.value).startswith(f"pasted: {said}") and raised.value.remedy


def test_a_tree_as_deep_as_json_goes():
    table = {"type": "PerspectiveCamera"}
    for _ in range(300):
        table = {"type": "Group", "children": [table]}
    assert len(pasted(json.dumps({"object": table})).cameras) == 1
