"""The limits of float32 for slivers, vast triangles and thin checkers: bounds that are tight."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from renderer import Camera
from renderer.edges import Discontinuities
from renderer.raster import scene_data
from renderer.scene import BUILTIN_SCENES, load_scene
from renderer.scene.flat import flatten
from renderer.scene.model import Checker, Material, Mesh, Scene, SceneObject, Sphere
from renderer.seen_surfaces import CLIPPED_FROM, MARGIN
from renderer.slivers import seen_corners, unknown_edge_px
from renderer.trace.packets.cells import are_blurred, cells_of

SIZE = (300, 200)
PERSPECTIVE = Camera(eye=(0.3, -0.2, 5.0), distance=1.5, viewport=(-0.8, 0.7, -0.4, 0.6))
PARALLEL = replace(PERSPECTIVE, projection="parallel", viewport=(-3.2, 2.8, -1.6, 2.4))
named = pytest.mark.parametrize("camera", [PERSPECTIVE, PARALLEL], ids=["perspective", "parallel"])


def test_the_margin_is_the_rasterizer_s():
    assert scene_data.MARGIN == MARGIN


@named
def test_points_are_seen_where_the_camera_projects_them(camera):
    points = np.random.default_rng(1).uniform(-1, 1, (5, 3, 3))
    seen = seen_corners(camera, SIZE, points)
    wanted = camera.project(points, SIZE)
    weight = 1.0 if camera.is_parallel else seen[..., 2]
    np.testing.assert_allclose(seen[..., 2], wanted.parameter)
    np.testing.assert_allclose(seen[..., 0] / weight + 149.5, wanted.column)
    np.testing.assert_allclose(seen[..., 1] / weight + 99.5, wanted.row)


def test_clipping_loses_vast_triangles_only_right_before_the_eye():
    floor = np.array([(0, 0, -5e6), (-4e6, 0, 4e6), (4e6, 0, 4e6)])
    flat = flatten(Scene((SceneObject(Mesh(floor, [[0, 1, 2]])),)))
    half = 1e-5
    camera = Camera.look_at((1, 1.5, 2), (1, 0, 1), (0, 1, 0))
    lines = Discontinuities(flat, replace(camera, viewport=(-half, half, -half, half)), (40, 8))
    i, j, primitive = np.array([4]), np.array([20]), np.array([0])
    t = lines.parameter(primitive, i, j, np.ones(1))
    from_t = float(lines.drawn_from(primitive)[0])
    assert from_t > t[0]
    assert lines.clip_px(primitive, i, j, t)[0] == 0
    usual = Discontinuities(flat, replace(camera, viewport=(-0.5, 0.5, -0.5, 0.5)), (40, 8))
    assert usual.drawn_from(primitive)[0] < 30
    # By what was drawn, clipping has lost nothing; only depth says what is too near to the eye.
    corners = [(x, 0.0, z) for x in (-4e6, 4e6) for z in (-5e6, 4e6)]
    farthest = lines.camera.project(corners, (40, 8)).parameter.max()
    for either in (lines, usual):
        drawn_from = either.drawn_from(primitive, drawn=True)
        assert drawn_from == pytest.approx([CLIPPED_FROM * farthest])
        assert either.clip_px(primitive, i, j, drawn_from * 0.99, drawn=True)[0] == 0
        assert either.clip_px(primitive, i, j, drawn_from * 1.01, drawn=True)[0] > 0
    largest = np.abs(seen_corners(lines.camera, (40, 8), floor[None])[..., :2]).max()
    assert from_t == pytest.approx(2.0**-21 / 1024 * largest)
    between = np.array([100.0])  # beyond the depth that is too near, within what clipping loses
    assert lines.clip_px(primitive, i, j, between)[0] == 0
    assert lines.clip_px(primitive, i, j, between, drawn=True)[0] > 0
    parallel = Discontinuities(flat, replace(camera, projection="parallel"), (40, 8))
    assert parallel.drawn_from(primitive) == [0]


@named
def test_an_edge_is_known_but_where_its_ends_are_seen_in_one_line_with_the_eye(camera):
    """In float32 the packets' formula stays within the bound, and a usual edge is known well."""
    rng = np.random.default_rng(3)
    largest = 0.0
    for away in (1.0, 1e-2, 1e-4):
        for _ in range(100):
            p, q = rng.normal(size=3) * (80, 60, 0), rng.normal(size=3) * (80, 60, 0)
            h = (1.0, 1.0)
            if not camera.is_parallel:  # before the eye and behind it, in opposite directions
                h = 10 ** rng.uniform(0, 3), -(10 ** rng.uniform(-2, 0))
                p, q = h[0] * p, h[1] * (p + away * q)
            p[2], q[2] = h
            exact, rounded = (
                np.cross(a + b, b - a) for a, b in ((p, q), (p.astype("f4"), q.astype("f4")))
            )
            if not rounded[:2].any():  # one point, then: covers nothing
                continue
            far = 0.0 if camera.is_parallel else rng.uniform(0, 100)
            x, y = -exact[2] * exact[:2] / (exact[:2] @ exact[:2])
            if camera.is_parallel:
                x, y = rng.uniform() * (q - p)[:2] + p[:2]
            x, y = np.array([x, y]) + far * np.array([-exact[1], exact[0]]) / np.hypot(*exact[:2])
            off = abs(rounded @ np.array([x, y, 1.0])) / np.hypot(*rounded[:2])
            at = np.array([y + 99.5]), np.array([x + 149.5])
            bound = unknown_edge_px(SIZE, p[None], q[None], camera.is_parallel, *at)[0]
            assert off <= bound
            largest = max(largest, off / bound)
            if away == 1.0 and camera.is_parallel:
                assert bound < 1 / 128
    assert largest > 0.02


def is_coarse_for_cells(scene: Scene, camera: Camera) -> bool:
    eye, back = np.array(camera.eye), np.array(camera.w)
    to_t = -camera.camera_from_world[2, :3]
    return are_blurred(
        cells_of(flatten(scene)), eye, to_t, back if camera.is_parallel else None, 2.0**-22
    )


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_usual_scenes_need_no_exact_cells(name):
    scene = load_scene(name)
    assert not is_coarse_for_cells(scene, scene.view.camera)


@named
def test_thin_cells_do(camera):
    squeezed = np.diag((1e-3, 500.0, 300.0, 1.0))
    corners = [(-1, 0, 0.5), (1, 0.1, -0.5), (0.2, 1.06, 0.3)]
    mesh = Mesh(corners, [[0, 1, 2]], transform=squeezed)
    plain = Scene((SceneObject(mesh), SceneObject(Sphere((0, 0, 0), 1.0))))
    assert not is_coarse_for_cells(plain, camera)
    thin = Scene((SceneObject(mesh, Material(checker=Checker(size=0.1))),))
    assert is_coarse_for_cells(thin, camera)


@pytest.mark.parametrize("is_parallel", [False, True])
def test_the_bound_is_eight_roundings_of_what_is_summed(is_parallel):
    """The sum has each product in (p + q) x (q - p) . (x, y, 1), over the edge's slope, and both
    ends.
    """
    products = np.abs(np.cross(np.eye(3)[:, None], np.eye(3)))
    for heights in ((2.0, 5.0), (3.0, -0.5), (-2.0, 0.25), (-1.0, -3.0)):
        p, q = np.array([(30.0, -50.0, 1.0), (-70.0, -20.0, 1.0)]) * np.reshape(heights, (2, 1))
        given = p, q
        if is_parallel:  # t says nothing of where a corner is seen
            p, q = np.array([(30.0, -50.0, 1.0), (-70.0, -20.0, 1.0)])
            given = tuple((x, y, t) for (x, y, _), t in zip((p, q), heights, strict=True))
        at = np.array([11.5, -33.5, 1.0])
        terms = np.einsum("i,j,k,jki", np.abs(at), np.abs(p + q), np.abs(q - p), products)
        slope = np.hypot(*np.cross(p + q, q - p)[:2])
        first, second = p[:2] / p[2], q[:2] / q[2]
        beyond = 1.0
        if not is_parallel and min(heights) < 0:
            beyond = math.dist(at[:2], first) + math.dist(at[:2], second)
            beyond /= math.dist(first, second)
        wanted = terms / slope + (np.hypot(*first) + np.hypot(*second)) * beyond
        pixel = np.array([99.5 - 33.5]), np.array([149.5 + 11.5])
        bound = unknown_edge_px(SIZE, *np.array([given])[0][:, None], is_parallel, *pixel)
        np.testing.assert_allclose(bound, 2.0**-21 * wanted, rtol=1e-12)


def test_of_an_edge_that_is_no_line_nothing_is_told():
    end = np.array([(30.0, -50.0, 1.0)])
    at = np.array([10]), np.array([20])
    assert unknown_edge_px(SIZE, end, end, False, *at) == 0.0
    assert unknown_edge_px(SIZE, end, end * (1, 1, 0), False, *at) == 0.0
