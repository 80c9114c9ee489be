"""An exported scene's colours, by Mitsuba's formulas from the file alone, are our tracer's."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from mitsuba_formulas import MitsubaFile

from renderer.camera import Camera
from renderer.scene import Scene, shapes
from renderer.scene.model import (
    Checker,
    DirectionalLight,
    Material,
    PointLight,
    SceneObject,
    Sphere,
)
from renderer.scene.shape_coordinates import on_plane
from renderer.scene.texture import Texture
from renderer.scene_export import export_scene
from renderer.trace import Tracer

SIZE = (24, 16)
FAR_LIGHT = 1e6  # whose light falls off by nothing that is seen

parts = st.integers(0, 16).map(lambda n: n / 16)
colors = st.tuples(parts, parts, parts)
small = st.integers(-8, 8).map(lambda n: n / 8)
places = st.tuples(small, small, small)


@st.composite
def textures(draw) -> Texture:
    rng = np.random.default_rng(draw(st.integers(0, 99)))
    texels = rng.integers(0, 256, (*rng.integers(1, 6, 2), 3)).astype(np.uint8)
    repeated = st.sampled_from(["repeat", "mirror"])
    wrap = draw(st.one_of(st.just(("clamp", "clamp")), st.tuples(repeated, repeated)))
    pair = st.tuples(st.floats(-3, 3), st.floats(-3, 3))
    return Texture(texels, wrap, draw(pair), draw(pair))


@st.composite
def materials(draw) -> Material:
    pattern = draw(
        st.one_of(
            st.just({}),
            st.fixed_dictionaries({"texture": textures()}),
            st.builds(lambda c: {"checker": Checker(c, 0.7)}, colors),
        )
    )
    shininess = draw(st.one_of(st.sampled_from([1.0, 1000.0]), st.floats(1, 1000)))
    return Material(draw(colors), draw(colors), shininess, **pattern)


@st.composite
def scenes(draw) -> Scene:
    """A sphere and a floor, of which either side may be seen, either hand."""
    flat = on_plane(shapes.rectangle(6, 5))
    if draw(st.booleans()):
        flat = replace(flat, colors=(flat.vertices * 0.1 + 0.5).astype(np.float32))
    turn = np.diag([*draw(st.sampled_from([(1, 1, 1), (1, -1, 1), (-1, 1, 1), (-1, -1, 1)])), 1.0])
    turn[:3, 3] = 0.1, -1, -0.2
    floor, ball = draw(materials()), draw(materials())
    if flat.colors is not None or floor.checker is not None:
        floor = replace(floor, texture=None)
    if flat.colors is not None:
        floor = replace(floor, checker=None)
    radius = draw(st.sampled_from([0.7, 40.0]))  # also around the eye
    objects = (
        SceneObject(flat.placed(turn), floor, "floor"),
        SceneObject(Sphere((0.2, 0.1, 0.3), radius), replace(ball, checker=None), "ball"),
    )
    directions = st.tuples(small, small.map(lambda y: y / 4 - 0.75), small)
    lights = [
        DirectionalLight(draw(directions), draw(colors)) for _ in range(draw(st.integers(0, 2)))
    ]
    return Scene(objects, tuple(lights), draw(colors), draw(colors))


def compare(scene: Scene, camera: Camera, folder: Path) -> int:
    """The number of pixels in which the two colours agree; the others are where a highlight goes on
    behind the horizon, and where a checker's cells meet."""
    export_scene(folder / "a.xml", scene, camera, SIZE)
    file = MitsubaFile(folder / "a.xml")
    with Tracer(scene, threads=1) as tracer:
        frame = tracer.render(camera, SIZE, ("color", "depth", "normal", "id"))
    rays = camera.rays(SIZE)
    missed = frame.id < 0
    np.testing.assert_allclose(frame.color[missed], missed[missed][:, None] * file.background, 1e-6)
    agreed = 0
    for number in range(len(scene.objects)):
        seen = frame.id == number
        if not seen.any():
            continue
        direction = np.broadcast_to(rays.direction, (*frame.id.shape, 3))[seen]
        point = np.broadcast_to(rays.origin, (*frame.id.shape, 3))[seen]
        point = point + frame.depth[seen][:, None] * direction
        normal = frame.normal[seen].astype(float)
        to_eye = -direction / np.linalg.norm(direction, axis=1, keepdims=True)
        theirs = file.radiance(number, point, normal, to_eye)
        lit = np.ones(len(point), bool)
        for light in scene.lights:
            if isinstance(light, DirectionalLight):
                lit &= normal @ -np.asarray(light.direction) > 1e-3
            else:
                lit &= (normal * (np.asarray(light.position) - point)).sum(axis=1) > 1e-3
        material = scene.objects[number].material
        lit |= not any(material.specular)
        if material.checker is not None:
            cell = point[:, [0, 2]] - scene.objects[number].shape.transform[[0, 2], 3]
            cell = cell / material.checker.size + 0.5
            lit &= (np.abs(cell - np.round(cell)) > 1e-3).all(axis=1)
        # A texel of 8 bits, and a table of 512 angles.
        tolerance = 0.012 if material.texture is not None else 2e-3
        np.testing.assert_allclose(theirs[lit], frame.color[seen][lit], 2e-3, tolerance)
        agreed += int(lit.sum())
    return agreed


@given(scenes(), places, st.booleans())
@settings(max_examples=40, deadline=None, derandomize=True, phases=[Phase.generate])
def test_any_scene_has_our_colours(scene: Scene, eye, is_parallel: bool):
    camera = Camera.look_at((3 * eye[0], 2 + eye[1], 5), (0, 0, 0), fov_y_deg=45, aspect=1.5)
    if is_parallel:
        camera = replace(camera, projection="parallel", viewport=(-3, 3, -2, 2))
    with tempfile.TemporaryDirectory() as folder:
        compare(scene, camera, Path(folder))


def test_a_ball_s_image_is_where_ours_is(tmp_path: Path):
    texels = np.arange(24).reshape(2, 4, 3).astype(np.uint8) * 10
    texture = Texture(texels, ("mirror", "repeat"), (2.0, 1.5), (0.1, 0.3))
    ball = SceneObject(Sphere((0.1, 0.2, 0.3)), Material((0.5, 0.9, 1.0), texture=texture))
    camera = Camera.look_at((2, 2, 5), (0, 0, 0), fov_y_deg=30, aspect=1.5)
    assert compare(Scene((ball,), ambient=(1.0, 1.0, 1.0)), camera, tmp_path) > 60


@pytest.mark.parametrize("specular", [(0.0, 0.0, 0.0), (0.6, 0.4, 0.2)])
def test_a_far_point_light_is_as_bright_as_here(specular, tmp_path: Path):
    ball = SceneObject(Sphere(), Material((0.5, 0.6, 0.7), specular, 12))
    lights = PointLight((0, 0.6 * FAR_LIGHT, FAR_LIGHT), (0.9, 0.8, 0.7)), PointLight((0, 0, 1e7))
    scene = Scene((ball,), lights, (3.0, 2.0, 0.1), (0.1, 0.0, 2.0))
    camera = Camera.look_at((0, 2, 5), (0, 0, 0), fov_y_deg=30, aspect=1.5)
    assert compare(scene, camera, tmp_path) > 60
