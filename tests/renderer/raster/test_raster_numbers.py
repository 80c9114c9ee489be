"""The rasterizer where numbers are large, small or far apart."""

from dataclasses import replace

import numpy as np
import pytest
from raster_scenes import CHECKERED, SIZE, WIDE, agrees, square, triangle
from trace_reference import reference

from lucida.renderer.camera.camera import Camera
from lucida.renderer.raster import setup
from lucida.renderer.raster.prepared import scene_setup
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import (
    Checker,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
)
from lucida.renderer.scene.positions import world_corners


class TestNumbers:
    """The precision that float32 would lose without the anchors and the rows of setup.py."""

    def test_telephoto_and_far_from_the_world_origin(self, rasterizer):
        def at(x, y, z):
            return 3e4 + x, -2e4 + y, 1e4 + z

        scene = Scene(
            (
                SceneObject(Sphere(at(0, 0, 0), 1.0), CHECKERED),
                SceneObject(triangle(at(1, 0, 0), at(3, 0, 1), at(2, 2, 0)), CHECKERED),
            ),
            (PointLight(at(3, 4, 5)),),
        )
        camera = Camera.look_at(at(100, 150, 240), at(0.8, 0, 0), fov_y_deg=1)
        frame = agrees(rasterizer, scene, camera, (96, 96))
        exact = reference(scene, camera, (96, 96))
        seen = (frame.id == exact.id) & (frame.id >= 0)
        assert seen.sum() > 1000
        np.testing.assert_allclose(frame.depth[seen], exact.depth[seen], rtol=1e-6)

    def test_a_planet_under_the_camera(self, rasterizer):
        planet = Scene(
            (SceneObject(Sphere((0, -1000, 0), 1000), CHECKERED),), (PointLight((9,) * 3),)
        )
        frame = agrees(rasterizer, planet, Camera.look_at((0, 0.05, 0), (0, 0, -0.3), fov_y_deg=60))
        assert (frame.id == 0).mean() > 0.5

    def test_a_planets_horizon(self, rasterizer):
        planet = Scene((SceneObject(Sphere((0, -1000, 0), 1000)),))
        camera = Camera.look_at((0, 0.005, 0), (0, 0, -2), fov_y_deg=10)
        rasterizer.set_scene(planet)
        depth = rasterizer.render(camera, SIZE).depth
        exact = reference(planet, camera, SIZE).depth
        seen = exact < 3
        assert seen.mean() > 0.1
        np.testing.assert_allclose(depth[seen], exact[seen], rtol=1e-5)

    def test_fine_checkers_through_a_telephoto_lens(self, rasterizer):
        """Hundreds of borders in a row of pixels: a hit may not slide along the ray."""
        fine = replace(CHECKERED, checker=Checker((0, 0, 0), 0.013))
        shapes = Sphere((-0.8, 0, 0), 0.8), triangle((0, -1, 0.5), (1.6, -1, -0.3), (0.8, 2, 0))
        scene = Scene(tuple(SceneObject(shape, fine) for shape in shapes))
        camera = Camera.look_at((60, 120, 268), (0, 0, 0), fov_y_deg=0.6)
        line = replace(camera, viewport=(-0.5, 0.5, -0.001, 0.001))
        agrees(rasterizer, scene, line, (3000, 4))

    def test_small_things_close_by_on_a_vast_plain(self, rasterizer):
        """Nearer than a millionth of the plain's extent."""
        plain = triangle((-1e5, 0, -1e5), (1e5, 0, -1e5), (0, 0, 1e5))
        scene = Scene(
            (
                SceneObject(plain, CHECKERED),
                SceneObject(Sphere((0, 0.5, -0.08), 0.015)),
                SceneObject(
                    triangle((-0.04, 0.5, -0.07), (0.04, 0.49, -0.07), (0.02, 0.53, -0.06))
                ),
            )
        )
        frame = agrees(rasterizer, scene, replace(WIDE, eye=(0, 0.5, 0)))
        assert set(frame.id.ravel().tolist()) == {-1, 0, 1, 2}

    def test_tiny_and_huge_worlds(self, rasterizer):
        for scale in (1e-6, 1e6):
            scene = Scene(
                (
                    SceneObject(Sphere((0, 0, -5 * scale), 2 * scale)),
                    SceneObject(square(4 * scale, -6 * scale)),
                )
            )
            frame = agrees(rasterizer, scene, Camera())
            assert frame.depth[18, 24] == pytest.approx(3 * scale, rel=1e-2)

    @pytest.mark.parametrize("projection", ["perspective", "parallel"])
    def test_the_planes_of_objects_are_those_of_their_triangles_in_the_world(
        self, projection, monkeypatch
    ):
        """However many objects there are in a block, and wherever each of them stands."""
        rng = np.random.default_rng(4)
        tetrahedron = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]) + 1000.0
        faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        transforms = np.tile(np.eye(4), (40, 1, 1))
        transforms[:, :3, :3] += rng.uniform(-0.4, 0.4, (40, 3, 3))
        transforms[::3, :3, 0] *= -1
        transforms[:, :3, :3] *= 10 ** rng.uniform(-3, 3, (40, 1, 1))
        turned = transforms[:, :3, :3] @ np.full(3, 1000.0)
        transforms[:, :3, 3] = rng.uniform(-1, 1, (40, 3)) - (0, 0, 5) - turned
        meshes = [Mesh(tetrahedron, faces, transform=matrix) for matrix in transforms]
        camera = Camera(eye=(0.3, 0.2, 4), projection=projection)
        flat = flatten(Scene(tuple(map(SceneObject, meshes))))
        prepared = scene_setup(flat)
        space = setup.image_space(camera, SIZE, flat, prepared)
        bases = setup.plane_bases(flat, prepared, space)
        corners = world_corners(flat, np.arange(160))
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        start = space.eye + space.across
        height = np.einsum("ni,ni->n", normals, corners[:, 0] - start)
        along = normals @ np.stack([space.step_x, space.step_y, space.direction], axis=1)
        if camera.is_parallel:
            expected = np.stack([-along[:, 0], -along[:, 1], height], axis=1) / along[:, 2:]
        else:
            expected = along / height[:, None]
        for few in (1, 100):
            monkeypatch.setattr(setup, "FEW_OBJECTS", few)
            rows = np.zeros((160, 3), np.float32)
            setup.triangle_rows(flat, prepared, bases, camera.is_parallel, rows[:7])
            setup.triangle_rows(flat, prepared, bases, camera.is_parallel, rows[7:], 7)
            size = np.abs(expected).max(axis=1, keepdims=True)
            np.testing.assert_allclose(rows / size, expected / size, atol=1e-5)
