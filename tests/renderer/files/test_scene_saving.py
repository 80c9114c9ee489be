"""Scenes written down: what is read back is the same scene."""

from __future__ import annotations

import os
import tomllib
from dataclasses import replace

import numpy as np
import pytest
from random_edits import check_same

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import BUILTIN_SCENES, load_scene, save_scene
from lucida.renderer.scene import (
    Checker,
    DirectionalLight,
    Material,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
    View,
    shapes,
)
from lucida.renderer.system.errors import LucidaError

OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_builtin_scenes_come_back(tmp_path, name):
    scene = load_scene(name)
    save_scene(tmp_path / "scene.toml", scene)
    check_same(load_scene(tmp_path / "scene.toml"), scene)


def test_the_view_of_the_window_becomes_the_files(tmp_path):
    camera = Camera((1 / 3, 2, 3), distance=0.1, viewport=(-0.2, 0.7, -0.5, 0.5), near=0.25)
    for view in (View(camera, fit=True), View(camera, fit=False)):
        save_scene(tmp_path / "scene.toml", load_scene("spheres"), view)
        assert load_scene(tmp_path / "scene.toml").view == view


def test_models_are_named_by_where_they_are(tmp_path):
    (tmp_path / "models").mkdir()
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "models" / "a b.obj").write_text(OBJ)
    first = tmp_path / "first.toml"
    first.write_text(
        '[[objects]]\ntype = "model"\nfile = "models/a b.obj"\ntranslate = [1, 2, 3]\n'
    )
    scene = load_scene(first)
    beside, away = tmp_path / "second.toml", tmp_path / "elsewhere" / "third.toml"
    save_scene(beside, scene)
    assert tomllib.loads(beside.read_text())["objects"][0]["file"] == "models/a b.obj"
    save_scene(away, scene)
    assert os.path.isabs(tomllib.loads(away.read_text())["objects"][0]["file"])
    for path in (beside, away):
        check_same(replace(load_scene(path), name=""), replace(scene, name=""))


def test_a_model_alone_becomes_a_scene(tmp_path):
    (tmp_path / "model.obj").write_text(OBJ)
    scene = load_scene(tmp_path / "model.obj")
    save_scene(tmp_path / "scene.toml", scene)
    check_same(load_scene(tmp_path / "scene.toml"), scene)


def test_scenes_made_in_python_are_written_by_their_parts(tmp_path):
    material = Material((0.1, 0.2, 0.3), (1, 1, 1), 7.0, Checker((1, 0, 0), 0.5))
    lights = (PointLight((1, 2, 3), (0.5, 0.25, 1)), DirectionalLight((0, -1, 0)))
    name = 'quotes " and \\ and \x7f and é'
    scene = Scene((SceneObject(Sphere((1, 2, 3), 0.5), material, name),), lights, name=name)
    save_scene(tmp_path / "scene.toml", scene)
    check_same(load_scene(tmp_path / "scene.toml"), scene)
    bare = Scene((SceneObject(Sphere()),), lights=())
    save_scene(tmp_path / "scene.toml", bare)
    assert load_scene(tmp_path / "scene.toml").lights == ()


def test_numpy_s_numbers_are_written_as_numbers(tmp_path):
    material = Material(np.float32([0.5, 0.25, 0]), shininess=np.float32(3), single_sided=np.True_)
    ball = SceneObject(Sphere(np.arange(3), np.float64(1.5)), material, "a")
    view = View(Camera(distance=np.float64(2)), fit=np.True_)
    scene = Scene((ball,), (PointLight(np.arange(3)),), np.ones(3), view=view, name="b")
    save_scene(tmp_path / "scene.toml", scene)
    found = load_scene(tmp_path / "scene.toml")
    check_same(found, scene)
    assert found.objects[0].shape == Sphere((0, 1, 2), 1.5)


def test_what_the_format_cannot_hold_is_said_and_nothing_written(tmp_path):
    scene = Scene((SceneObject(shapes.box(), name="crate"),))
    with pytest.raises(LucidaError, match=r"objects\[0\].*crate.*made in Python"):
        save_scene(tmp_path / "scene.toml", scene)
    assert list(tmp_path.iterdir()) == []
