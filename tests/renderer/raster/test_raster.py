"""The rasterizer's images: analytic answers first, then every kind of camera against float64."""

from dataclasses import replace

import numpy as np
import pytest
from raster_scenes import CAMERAS, SIZE, WIDE, agrees, square, still_life, triangle

from lucida.renderer.camera.camera import Camera
from lucida.renderer.compare.raster_and_ray import CHANNELS
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Mesh, PointLight, Scene, SceneObject, Sphere


def test_a_sphere_ahead_has_the_depths_computed_by_hand(rasterizer):
    rasterizer.set_scene(Scene((SceneObject(Sphere((0, 0, -5), 3.0)),)))
    frame = rasterizer.render(Camera(), (3, 3), CHANNELS)
    assert frame.depth[1, 1] == pytest.approx(2, rel=1e-6)
    np.testing.assert_allclose(frame.normal[1, 1], (0, 0, 1), atol=1e-6)
    assert frame.id[1, 1] == 0
    assert frame.primitive[1, 1] == 0
    # The corners' rays: |(1/3, 1/3, -1) t - (0, 0, -5)| = 3.
    a, b, c = 11 / 9, -10, 16
    t = (-b - np.sqrt(b * b - 4 * a * c)) / (2 * a)
    np.testing.assert_allclose(frame.depth[::2, ::2], t, rtol=1e-6)


def test_depth_is_the_ray_parameter_not_a_distance(rasterizer):
    """A plane across the view has one depth everywhere; so it has in multiples of d."""
    rasterizer.set_scene(Scene((SceneObject(square(100, -6.0)),)))
    frame = rasterizer.render(replace(WIDE, distance=1.5), SIZE)
    np.testing.assert_allclose(frame.depth, 4, rtol=1e-6)
    np.testing.assert_allclose(frame.normal, np.broadcast_to((0, 0, 1), (36, 48, 3)), atol=1e-6)
    parallel = replace(WIDE, projection="parallel", w=(0, 0, 2))
    np.testing.assert_allclose(rasterizer.render(parallel, SIZE).depth, 3, rtol=1e-6)


def test_a_triangle_covers_the_pixels_whose_centres_project_into_it(rasterizer):
    corners = np.array([(-0.51, -0.38, -1), (0.63, -0.22, -2), (0.1, 0.57, -1.5)])
    rasterizer.set_scene(Scene((SceneObject(triangle(*corners)),)))
    seen = rasterizer.render(WIDE, SIZE).id == 0
    row, column, _ = WIDE.project(corners, SIZE)
    i, j = np.mgrid[: SIZE[1], : SIZE[0]]
    sides = []
    for k in range(3):
        along_i, along_j = row[k - 1] - row[k], column[k - 1] - column[k]
        across = (i - row[k]) * along_j - (j - column[k]) * along_i
        sides.append(across / np.hypot(along_i, along_j))
    inside = np.min(np.multiply(sides, np.sign(np.sum(sides, 0))), axis=0)
    assert seen[inside > 1 / 128].all()
    assert not seen[inside < -1 / 128].any()
    assert 100 < seen.sum() < seen.size / 2


def test_an_empty_scene_is_background(rasterizer):
    rasterizer.set_scene(Scene((), background=(0.25, 0.5, 2.0)))
    frame = rasterizer.render(WIDE, (5, 3), CHANNELS)
    assert (frame.color == (0.25, 0.5, 2.0)).all()
    assert np.isposinf(frame.depth).all()
    assert (frame.normal == 0).all()
    assert (frame.id == -1).all()
    assert (frame.primitive == -1).all()


def test_the_first_of_two_equal_surfaces_wins(rasterizer):
    rasterizer.set_scene(Scene(tuple(SceneObject(square(5, -2.0)) for _ in range(3))))
    assert (rasterizer.render(WIDE, SIZE).id == 0).all()


def test_a_triangle_without_area_is_not_seen(rasterizer):
    line = triangle((-1, 0, -2), (0, 0, -2), (1, 0, -2))
    point = triangle((0, 0, -2), (0, 0, -2), (0, 0, -2))
    rasterizer.set_scene(Scene((SceneObject(line), SceneObject(point))))
    assert (rasterizer.render(WIDE, (7, 7)).id == -1).all()


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize("name", CAMERAS)
def test_every_camera_agrees_with_float64(rasterizer, name, projection):
    camera = replace(CAMERAS[name], projection=projection)
    if projection == "parallel":
        camera = replace(camera, viewport=tuple(3 * edge for edge in camera.viewport))
    agrees(rasterizer, still_life(), camera)


def test_normals_that_disagree_with_the_winding_are_turned(rasterizer):
    """The visible side counts: neither the winding nor the normals' sign shows."""
    corners = np.array([(-1, -1, -3), (1, -1, -2.5), (0, 1, -2)])
    normals = np.array([(-0.6, 0, 0.8), (0.6, 0, 0.8), (0, 0.6, 0.8)])
    light = (PointLight((1, 2, 3)),)
    frames = []
    for order in ([0, 1, 2], [0, 2, 1]):
        for sign in (1, -1):
            mesh = Mesh(corners, np.array([order]), normals=sign * normals)
            rasterizer.set_scene(Scene((SceneObject(mesh),), light))
            frames.append(rasterizer.render(WIDE, SIZE))
    assert (frames[0].id == 0).sum() > 200
    assert (frames[0].normal[frames[0].id == 0][:, 2] > 0.5).all()
    for frame in frames[1:]:
        both = (frame.id == 0) & (frames[0].id == 0)
        np.testing.assert_allclose(frame.normal[both], frames[0].normal[both], atol=1e-5)
        np.testing.assert_allclose(frame.color[both], frames[0].color[both], atol=1e-5)


def test_near_opens_a_sphere_and_shows_its_inside(rasterizer):
    scene = Scene((SceneObject(Sphere((0, 0, -3), 1.0)),))
    frame = agrees(rasterizer, scene, replace(WIDE, near=3.0), SIZE)
    assert frame.depth[18, 24] == pytest.approx(4, rel=1e-2)
    assert frame.normal[18, 24, 2] == pytest.approx(1, abs=1e-2)


def test_a_surface_is_cut_where_the_ray_parameter_says_so(rasterizer):
    for projection in ("perspective", "parallel"):
        camera = Camera.look_at((4, 5, 6), (0, 0, 0), fov_y_deg=35, projection=projection)
        if projection == "parallel":
            camera = replace(camera, viewport=(-2, 2, -2, 2))
        agrees(rasterizer, still_life(), replace(camera, near=8.0, far=10.0))


def test_parallel_rays_begin_at_the_eyes_plane(rasterizer):
    inside = replace(WIDE, eye=(0, 0, 0.3), projection="parallel", viewport=(-2, 2, -2, 2))
    frame = agrees(rasterizer, still_life(), inside)
    assert frame.depth.min() > 0


def test_slivers_keep_to_the_colours_of_their_corners(rasterizer):
    """Vertices are snapped to a fraction of a pixel: a centre may lie outside of what covers it."""
    rng = np.random.default_rng(1)
    corners = rng.uniform(-1, 1, (400, 3, 3)) - (0, 0, 3)
    corners[:, 2] = corners[:, 1] + rng.normal(scale=0.004, size=(400, 3))
    colors = np.tile(np.eye(3), (400, 1))  # the colour is the barycentrics
    mesh = Mesh(corners.reshape(-1, 3), np.arange(1200).reshape(-1, 3), colors=colors)
    white = Material((1, 1, 1))
    rasterizer.set_scene(Scene((SceneObject(mesh, white),), ambient=(1, 1, 1)))
    frame = rasterizer.render(WIDE, (200, 150))
    seen = frame.color[frame.id == 0]
    assert len(seen) > 1000
    assert seen.min() >= 0
    np.testing.assert_allclose(seen.sum(axis=1), 1, atol=1e-6)


def test_samples_are_averaged_in_linear_light(rasterizer):
    scene = still_life()
    rasterizer.set_scene(scene)
    camera = CAMERAS["from above"]
    fine = rasterizer.render(camera, (96, 72), ("color",)).color
    coarse = rasterizer.render(camera, (48, 36), samples=4)
    mean = fine.reshape(36, 2, 48, 2, 3).mean(axis=(1, 3))
    assert np.median(np.abs(coarse.color - mean)) < 1e-6
    assert (np.abs(coarse.color - mean).max(axis=2) < 1e-3).mean() > 0.98
    np.testing.assert_array_equal(coarse.id, rasterizer.render(camera, (48, 36)).id)
