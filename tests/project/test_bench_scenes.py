"""The benchmarks' meshes and cameras."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from renderer.trace import Tracer
from tests.benchmarks import cameras, interior, meshes, scenes
from tests.benchmarks.tables import visibility

SIZE = (32, 18)
CLOSED = [meshes.knot, meshes.bumpy_sphere, meshes.table_top, meshes.scanned_sphere]


def small():
    return scenes.SUBJECTS["small"]()


def hit_pixels(subject, view):
    """(height, width) bool."""
    with Tracer(scenes.scene_of(subject)) as tracer:
        return tracer.render(view.camera, view.size, ("primitive",)).channel("primitive") >= 0


class TestMeshes:
    @pytest.mark.parametrize("make", CLOSED)
    @pytest.mark.parametrize("triangles", [600, 20_000])
    def test_about_as_many_triangles_as_wanted(self, make, triangles):
        _, faces = make(triangles)
        assert len(faces) == pytest.approx(triangles, rel=0.12)

    @pytest.mark.parametrize("make", CLOSED)
    def test_closed_and_turned_outwards(self, make):
        vertices, faces = make(3000)
        edges = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        # Each edge is walked once in each direction: closed, and all faces turned alike.
        forth, counts = np.unique(edges, axis=0, return_counts=True)
        assert (counts == 1).all()
        assert (forth == np.unique(edges[:, ::-1], axis=0)).all()
        a, b, c = vertices[faces.T].astype(float)
        assert np.einsum("ij,ij->", a, np.cross(b, c)) > 0  # 6 times the volume

    def test_every_vertex_is_used(self):
        for make in (meshes.knot, meshes.bumpy_sphere, interior.interior):
            vertices, faces = make(0.5 if make is interior.interior else 2000)
            assert (np.unique(faces) == np.arange(len(vertices))).all()

    @pytest.mark.parametrize("make", [meshes.bumpy_sphere, meshes.scanned_sphere])
    def test_every_direction_leaves_the_ball_once(self, make):
        vertices, faces = make(5000)
        a, b, c = vertices[faces.T].astype(float)
        # Star-shaped: seen from the centre, all faces are turned away.
        assert (np.einsum("ij,ij->i", a, np.cross(b, c)) > 0).all()

    def test_the_hall_has_triangles_of_very_different_sizes(self):
        vertices, faces = interior.interior()
        assert len(faces) == pytest.approx(262_000, rel=0.02)
        a, b, c = vertices[faces.T].astype(float)
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
        assert np.quantile(area, 0.9) < 0.02
        assert area.max() > 100

    def test_the_soup_is_triangles_anyhow(self):
        vertices, faces = meshes.soup(2000)
        assert faces.shape == (2000, 3)
        a, b, c = vertices[faces.T].astype(float)
        lengths = np.linalg.norm([b - a, c - b, a - c], axis=-1)
        assert lengths.mean() == pytest.approx(0.06, rel=0.2)
        normal = np.cross(b - a, c - a)
        assert (np.linalg.norm(normal, axis=1) > 0).all()
        assert np.abs(normal.mean(axis=0)).max() < 0.1 * np.abs(normal).mean()

    def test_a_model_file_is_one_mesh(self, tmp_path):
        file = tmp_path / "one.obj"
        file.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        subject = scenes.model(file)
        assert (subject.name, subject.triangles) == ("one.obj", 1)


class TestCameras:
    @pytest.mark.parametrize("number", range(3))
    def test_rays_are_the_cameras(self, number):
        camera = cameras.easy_views(small(), SIZE)[number].camera
        origins, directions = cameras.rays(camera, SIZE)
        exact = camera.rays(SIZE)
        assert origins.dtype == directions.dtype == np.float32
        np.testing.assert_allclose(origins, exact.origin.reshape(-1, 3), atol=1e-5)
        np.testing.assert_allclose(directions, exact.direction.reshape(-1, 3), atol=1e-6)

    def test_the_skewed_view_is_skewed(self):
        u, v, w = cameras.easy_views(small(), SIZE)[2].camera.basis.T
        assert min(abs(u @ v), abs(v @ w), abs(w @ u)) > 0.01

    @pytest.mark.parametrize("name", ["small", "ball 4k"])
    def test_all_views_see_the_subject(self, name):
        subject = scenes.SUBJECTS[name]()
        for view in cameras.easy_views(subject, SIZE) + cameras.hard_views(subject, SIZE):
            at = view.camera.project(subject.vertices, view.size)
            inside = (at.row > 0) & (at.row < SIZE[1]) & (at.column > 0) & (at.column < SIZE[0])
            assert inside.any(), view.name

    @pytest.mark.parametrize("density", [0.1, 1, 3, 10, 30])
    def test_so_many_triangles_fall_on_a_pixel_that_is_hit(self, density):
        # All that counts of an image's size and the triangles is their proportion.
        size, part = (320, 180), 16
        name = next(name for name, own in visibility.DENSITIES.items() if density in own)
        wanted = {"scan 66k": 66_000, "scan 660k": 660_000, "scan 2M": 2_000_000}[name] // part
        subject = scenes.Subject(name, *meshes.scanned_sphere(wanted))
        view = cameras.dense_view(subject, density, size)
        hit = hit_pixels(subject, view)
        assert cameras.facing(subject, view.camera, size) / hit.sum() == pytest.approx(
            density, rel=0.2
        )
        assert not (hit[[0, -1]].any() or hit[:, [0, -1]].any())  # whole in view

    def test_every_ray_hits_from_within(self):
        hall = scenes.Subject("hall", *interior.interior(0.5))
        ball = scenes.SUBJECTS["ball 4k"]()
        for view in cameras.interior_views((64, 36)):
            assert hit_pixels(hall, view).all(), view.name
        assert hit_pixels(ball, cameras.within(ball, (64, 36))).all()

    def test_triangles_that_face_the_eye(self):
        block = scenes.Subject("block", *meshes.block((1.0, 1.0, 1.0)))
        far = cameras.look(block, SIZE, radii=5.0)
        assert cameras.facing(block, far, SIZE) == 6
        parallel = replace(far, projection="parallel", viewport=(-2.0, 2.0, -2.0, 2.0))
        assert cameras.facing(block, parallel, SIZE) == 6
        assert cameras.facing(block, replace(parallel, viewport=(2.0, 3.0, 2.0, 3.0)), SIZE) == 0
        ball = scenes.SUBJECTS["ball 4k"]()
        inside = cameras.within(ball, SIZE)
        assert 0 < cameras.facing(ball, inside.camera, SIZE) < ball.triangles / 2
