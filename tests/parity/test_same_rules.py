"""Cases at the limits of the shading rules: every renderer, and the reference, decide alike."""

import numpy as np
import pytest
from agreeing import agree
from scenes import moved, placed
from trace_reference import reference

from lucida import Camera, Rasterizer, Tracer
from lucida.app.instruments.probe.model import Probe
from lucida.renderer.compare.raster_and_ray import CHANNELS, compare_frames
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import DirectionalLight, Mesh, PointLight, Scene, SceneObject

SIZE = (33, 33)
LIGHTS = (PointLight((0.5, 1, 0.5)), DirectionalLight((-1, -1, -2), (0.5, 0.4, 0.3)))
MATERIAL = Material((0.6, 0.5, 0.4), (0.4, 0.4, 0.4), 20)


def all_agree(scene, camera, size=SIZE):
    """The rasterizer's image, with which four others agree: the tracers', the reference's, and
    the probe's in the middle."""
    frame, _, _ = agree(scene, camera, size)
    assert np.isfinite(frame.color).all()
    flat = flatten(scene)
    result = compare_frames(flat, camera, size, frame, reference(scene, camera, size))
    assert result.unexplained == 0, result.summary()
    middle = size[1] // 2, size[0] // 2
    read = Probe(scene).at(middle, camera, size)
    np.testing.assert_allclose(read.color, frame.color[middle], atol=3e-3)
    return frame


@pytest.mark.parametrize("order", [(0, 1, 2), (0, 2, 1)])
@pytest.mark.parametrize("turn_deg", [0.0, 20.0, -35.0])
def test_vertex_normals_whose_sum_lies_in_their_triangle(order, turn_deg):
    corners = [(-1.1, -1, 0), (1.2, -0.9, 0), (0.1, 1.3, 0)]
    normals = [(0.6, 0, 0.8), (0.6, 0, -0.8), (1, 0, 0)]
    mesh = placed(Mesh(corners, [order], normals), 0.02, 0.01, -2, turn_deg)
    scene = Scene((SceneObject(mesh, MATERIAL),), LIGHTS)
    frame = all_agree(scene, Camera())
    # Smooth: normals are not the triangle's.
    facing = frame.normal[frame.id == 0]
    assert len(facing) > 200
    assert np.ptp(facing, axis=0).max() > 0.5


@pytest.mark.parametrize("tilt", [0.0, 0.75])
@pytest.mark.parametrize("far", [0.0, 1e3])
def test_a_point_light_that_lies_on_a_surface(tilt, far):
    """Exactly at the light, there is no direction to it, and it adds nothing."""
    corners = [(-4, -3, -2 - 3 * tilt), (4, -3, -2 - 3 * tilt), (0, 5, -2 + 5 * tilt)]
    light = PointLight((0, 0, -2), (5, 5, 5))
    sun = DirectionalLight((0, 0, -1), (0.5, 0.5, 0.5))
    wall = SceneObject(Mesh(corners, [[0, 1, 2]]), MATERIAL)
    by = far * np.array([1, -2, 4.0])
    scene, bare = moved(Scene((wall,), (light, sun)), by), moved(Scene((wall,), (sun,)), by)
    camera = Camera(eye=tuple(by))
    frame = all_agree(scene, camera)
    with Rasterizer(bare) as rasterizer:
        without = rasterizer.render(camera, SIZE, CHANNELS)
    np.testing.assert_allclose(frame.color[16, 16], without.color[16, 16], atol=1e-6)


def test_triangles_too_small_for_a_square_in_float32():
    """Twice their area is 1e-22 and its square is 0: they have a normal all the same."""
    corners = np.array([(-1, -1, 0), (1, -1, 0.5), (0, 1, 0.2)])
    tiny = np.diag([1e-11, 1e-11, 1e-11, 1.0])
    tiny[2, 3] = -3e-11
    scene = Scene((SceneObject(Mesh(corners, [[0, 1, 2]], transform=tiny), MATERIAL),), LIGHTS[1:])
    with Rasterizer(scene) as rasterizer, Tracer(scene) as tracer:
        first, second = (r.render(Camera(), SIZE, CHANNELS) for r in (rasterizer, tracer))
    both = (first.id == 0) & (second.id == 0)
    assert both.sum() > 100
    np.testing.assert_allclose(first.normal[both], second.normal[both], atol=1e-4)
    np.testing.assert_allclose(first.color[both], second.color[both], atol=1e-3)
