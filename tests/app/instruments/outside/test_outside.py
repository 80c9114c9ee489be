"""The outside view's diagram: what of the camera is drawn, its handles, its rays, how motions are
told. Against the camera's own arithmetic."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from looked_at import SIZE, cameras, looking_cameras, vectors

from lucida.app.images.ray_pictures import RayPainter
from lucida.app.instruments.outside.camera_diagram import Content, diagram
from lucida.app.instruments.outside.diagram import Arrow, Label, RayEnd, Segments
from lucida.app.instruments.outside.extent import arrow_length
from lucida.app.instruments.outside.gizmo import (
    gl_matrices,
    nearest_rotation,
)
from lucida.app.instruments.outside.looking import ray_depths
from lucida.app.instruments.outside.projected import Text, project
from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.app.state.options.outside import OutsideOptions
from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import Scene, SceneObject, Sphere
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.trace import Tracer


class TestDiagram:
    def names(self, camera: Camera, options: OutsideOptions, **more: Any) -> set[str]:
        return {item.name for item in diagram(Content(camera, SIZE, options, 9.0, **more))}

    def test_each_switch_has_its_lines(self) -> None:
        camera, none = Camera.canonical(), OutsideOptions(None, False, False, False, False, False)
        hit = RayEnd((3, 4), 2.5)
        assert self.names(camera, none, marked=hit) == {"eye"}
        for field, names in {
            "volume": {"edges", "side", "end"},
            "image": {"image plane"},
            "grid": {"grid", "image plane"},
            "basis": {"u", "v", "w"},
            "ray": {"ray", "pixel", "hit", "beyond"},
        }.items():
            assert names <= self.names(camera, replace(none, **{field: True}), marked=hit), field

    @pytest.mark.parametrize("reach", [2e-3, 0.42, 3.0, 29.0, 2e3])
    def test_arrows_have_a_readable_length_that_their_names_state(self, reach: float) -> None:
        camera, arrow = Camera.canonical(), arrow_length(reach)
        items = diagram(Content(camera, SIZE, OutsideOptions(), 9.0, arrow=arrow))
        (tip,) = (item.end for item in items if isinstance(item, Arrow) and item.name == "u")
        (label,) = (item.text for item in items if isinstance(item, Label) and item.name == "u")
        assert np.allclose(tip, arrow * np.asarray(camera.u))
        assert label == ("vec(u)" if arrow == 1 else f"{arrow:g} vec(u)")
        assert 0.03 < arrow / reach <= 1

    def test_near_and_far_are_drawn_where_they_are_set(self) -> None:
        camera = replace(Camera.canonical(), near=2.0, far=4.0)
        items = diagram(Content(camera, SIZE, OutsideOptions(), 9.0))
        at = {item.name: item for item in items if isinstance(item, Segments)}
        assert np.allclose(at["near"].segments[..., 2], -2)
        assert np.allclose(at["far"].segments[..., 2], -4)
        assert {at["edges"].segments[..., 2].min(), at["edges"].segments[..., 2].max()} == {-4, -2}
        assert "end" not in at

    def test_a_volume_that_begins_behind_the_scene_ends_half_as_far_again(self) -> None:
        camera = replace(Camera.canonical(), near=10.0)
        items = diagram(Content(camera, SIZE, OutsideOptions(), 9.0))
        at = {item.name: item for item in items if isinstance(item, Segments)}
        assert set(at["edges"].segments[..., 2].flat) == {-15, -10}

    def test_a_ray_ends_where_it_hits_and_goes_on_pale(self) -> None:
        camera = Camera.canonical()
        items = diagram(Content(camera, SIZE, OutsideOptions(), 9.0, marked=RayEnd((10, 20), 2.5)))
        at = {item.name: item for item in items if isinstance(item, Segments)}
        ray = camera.ray(10, 20, SIZE)
        reached = ray.origin + 2.5 * ray.direction
        assert np.allclose(at["ray"].segments, [[ray.origin, reached]])
        assert np.allclose(at["beyond"].segments[0, 0], reached)
        for t in (None, math.inf):
            names = self.names(camera, OutsideOptions(), marked=RayEnd((10, 20), t))
            assert "hit" not in names
            assert "ray" in names

    @given(cameras(), cameras(), st.sampled_from([1e-5, 1.0, 1e7]))
    def test_any_camera_looks_at_any_other(
        self, camera: Camera, looking: Camera, scale: float
    ) -> None:
        try:
            camera = replace(camera, eye=tuple(scale * np.asarray(camera.eye)))
        except LucidaError:
            assume(False)
        options = OutsideOptions(bundle=(2, 2))
        hits = [RayEnd((1, 1), 2.0), RayEnd((5, 5), math.inf)]
        items = diagram(Content(camera, SIZE, options, 5.0, hits, RayEnd((2, 2), 0.5)))
        for at in (looking, camera):
            for part in project(items, OutsideScreen(at, SIZE, 1e-4)):
                if isinstance(part, Text):
                    assert np.isfinite((*part.at, *part.toward)).all()
                else:
                    assert np.isfinite(part.points).all()
                    assert np.isfinite(part.depth).all()


class TestHandles:
    @given(cameras(), vectors, st.floats(-3, 3))
    def test_a_turn_is_found_again_from_any_basis(
        self, camera: Camera, axis: tuple[float, float, float], angle: float
    ) -> None:
        assume(np.linalg.norm(axis) > 0.1)
        x, y, z = np.asarray(axis) / np.linalg.norm(axis)
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        turn = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
        basis = {name: tuple(turn @ getattr(camera, name)) for name in "uvw"}
        turned = replace(camera, **basis).basis @ np.linalg.inv(camera.basis)
        assert np.allclose(nearest_rotation(turned), turn, atol=1e-6)

    def test_there_are_none_where_the_eye_is_not_well_in_front(self) -> None:
        for camera in looking_cameras():
            eye = np.asarray(camera.eye)
            assert gl_matrices(camera, eye - 5 * np.asarray(camera.w), 3.0) is not None
            assert gl_matrices(camera, eye, 3.0) is None
            assert gl_matrices(camera, eye + 5 * np.asarray(camera.w), 3.0) is None


def test_rays_end_where_the_image_sees_something() -> None:
    scene = Scene((SceneObject(Sphere((0.0, 0.0, -3.0), 1.0)),))
    camera, pixels = Camera.canonical(), ((0, 0), (SIZE[1] // 2, SIZE[0] // 2))
    with Tracer(scene, threads=1) as tracer:
        found = ray_depths((camera, SIZE, pixels), RayPainter(scene, tracer, lambda: True))
        depth = tracer.render(camera, SIZE, ("depth",)).channel("depth")
    assert found == pytest.approx({pixel: float(depth[pixel]) for pixel in pixels})
    assert math.isinf(found[pixels[0]]) and math.isfinite(found[pixels[1]])
