"""Distances from lines in the image, beside the same found by sampling the lines in the world."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from renderer import Camera
from renderer.edges import Discontinuities
from renderer.scene.flat import flatten
from renderer.scene.model import Checker, Material, Mesh, Scene, SceneObject, Sphere

SIZE = (320, 240)
# Distance, viewport, basis and eye each other than the canonical camera's.
PERSPECTIVE = Camera(
    eye=(0.3, -0.2, 1.0),
    u=(1.0, 0.1, 0.0),
    v=(0.0, 1.2, 0.1),
    w=(0.1, 0.0, 0.9),
    distance=2.0,
    viewport=(-1.1, 0.9, -0.6, 0.9),
)
PARALLEL = replace(PERSPECTIVE, projection="parallel", viewport=(-2.2, 1.8, -1.2, 1.8))
CAMERAS = [PERSPECTIVE, PARALLEL]
named = pytest.mark.parametrize("camera", CAMERAS, ids=["perspective", "parallel"])


def nearest_px(camera: Camera, points: np.ndarray, i: np.ndarray, j: np.ndarray) -> np.ndarray:
    """From each pixel the distance to the nearest of the projected world points (n, 3)."""
    seen = camera.project(points, SIZE)
    row, column = seen.row[None, :] - i[:, None], seen.column[None, :] - j[:, None]
    return np.nanmin(np.hypot(row, column), axis=1)


def pixels(camera: Camera, points: np.ndarray, away_px: float) -> tuple[np.ndarray, np.ndarray]:
    """(row, column), at random, within away_px of the projected points."""
    rng = np.random.default_rng(5)
    seen = camera.project(points[rng.integers(0, len(points), 60)], SIZE)
    i = seen.row + rng.uniform(-away_px, away_px, 60)
    j = seen.column + rng.uniform(-away_px, away_px, 60)
    near = (np.abs(i) < 2000) & (np.abs(j) < 2000)
    return i[near], j[near]


def edges(corners: np.ndarray) -> np.ndarray:
    part = np.linspace(0, 1, 8_001)[:, None]
    pairs = ((0, 1), (1, 2), (2, 0))
    return np.concatenate([corners[a] + part * (corners[b] - corners[a]) for a, b in pairs])


@named
@pytest.mark.parametrize("away_px", [0.5, 60.0])
def test_the_outline_of_triangles(camera, away_px):
    rng = np.random.default_rng(2)
    for _ in range(4):
        corners = rng.uniform((-2, -2, -6), (2, 2, -2), (3, 3))
        lines = Discontinuities(
            flatten(Scene((SceneObject(Mesh(corners, [[0, 1, 2]])),))), camera, SIZE
        )
        points = edges(lines.flat.vertices[lines.flat.faces[0]].astype(float))
        i, j = pixels(camera, points, away_px)
        found = lines.outline_px(np.zeros(len(i), int), i, j)
        np.testing.assert_allclose(found, nearest_px(camera, points, i, j), atol=0.05)


@pytest.mark.parametrize("behind", [1, 2])
def test_of_triangles_that_reach_behind_the_eye_the_edges_in_front_count(behind):
    corners = np.array([(-1.0, 0.5, -4.0), (1.0, -0.5, -3.0), (0.4, 0.3, -5.0)])
    corners[:behind, 2] *= -1
    for order in ((0, 1, 2), (1, 2, 0), (2, 1, 0)):
        flat = flatten(Scene((SceneObject(Mesh(corners[list(order)], [[0, 1, 2]])),)))
        lines = Discontinuities(flat, PERSPECTIVE, SIZE)
        points = edges(flat.vertices[flat.faces[0]].astype(float))
        i, j = pixels(PERSPECTIVE, points[~np.isnan(PERSPECTIVE.project(points, SIZE).row)], 9.0)
        inside = (np.abs(i - 120) < 120) & (np.abs(j - 160) < 160)
        i, j = i[inside], j[inside]
        assert len(i) > 5
        found = lines.outline_px(np.zeros(len(i), int), i, j)
        np.testing.assert_allclose(found, nearest_px(PERSPECTIVE, points, i, j), atol=0.05)


def test_of_triangles_behind_the_eye_there_is_no_outline():
    corners = [(-1.0, 0.5, 4.0), (1.0, -0.5, 3.0), (0.4, 0.3, 5.0)]
    flat = flatten(Scene((SceneObject(Mesh(corners, [[0, 1, 2]])),)))
    i, j = np.meshgrid(np.arange(0, 240, 30), np.arange(0, 320, 40))
    lines = Discontinuities(flat, PERSPECTIVE, SIZE)
    found = lines.outline_px(np.zeros(i.size, int), i.ravel(), j.ravel())
    assert np.isinf(found).all()


def silhouette(camera: Camera, center: np.ndarray, radius: float) -> np.ndarray:
    """Points (n, 3) of the sphere's outline: where its normal is perpendicular to the rays."""
    if camera.is_parallel:
        axis, middle, reach = np.asarray(camera.w), center, radius
    else:
        axis = np.asarray(camera.eye) - center
        far = np.linalg.norm(axis)
        middle = center + axis * (radius / far) ** 2
        reach = radius * np.sqrt(1 - (radius / far) ** 2)
    axis = axis / np.linalg.norm(axis)
    across = np.cross(axis, (0.3, 1.0, 0.2))
    across /= np.linalg.norm(across)
    angle = np.linspace(0, 2 * np.pi, 8_001)[:, None]
    return middle + reach * (np.cos(angle) * across + np.sin(angle) * np.cross(axis, across))


@named
@pytest.mark.parametrize(("center", "radius"), [((0.2, 0.1, -4), 0.8), ((-1, 0.8, -3), 0.3)])
def test_the_outline_of_spheres(camera, center, radius):
    """To first order: near the curve."""
    flat = flatten(Scene((SceneObject(Sphere(center, radius)),)))
    points = silhouette(camera, np.asarray(center, float), radius)
    i, j = pixels(camera, points, 0.4)
    found = Discontinuities(flat, camera, SIZE).outline_px(np.zeros(len(i), int), i, j)
    np.testing.assert_allclose(found, nearest_px(camera, points, i, j), atol=0.05)


def plane(normal, through) -> SceneObject:
    """A large triangle."""
    normal = np.asarray(normal, float)
    across = np.cross(normal, (0.2, 0.3, 1.0))
    up = np.cross(normal, across)
    corners = [np.asarray(through) + a * across + b * up for a, b in ((-9, -9), (9, -9), (0, 9))]
    return SceneObject(Mesh(corners, [[0, 1, 2]]))


PLANES = ((0.2, 0.6, 1.0), (0, 0, -3)), ((-0.7, 0.1, 1.0), (0, 0, -3))


def hits(lines: Discontinuities, primitive: int, i: np.ndarray, j: np.ndarray) -> np.ndarray:
    return lines.parameter(np.full(len(i), primitive), i, j, np.ones(len(i)))


@named
def test_where_planes_meet(camera):
    lines = Discontinuities(flatten(Scene(tuple(plane(*one) for one in PLANES))), camera, SIZE)
    along = np.cross(PLANES[0][0], PLANES[1][0])
    points = np.array(PLANES[0][1]) + np.linspace(-2, 2, 8_001)[:, None] * along
    i, j = pixels(camera, points, 0.4)
    first, second = np.zeros(len(i), int), np.ones(len(i), int)
    t = hits(lines, 0, i, j)
    wanted = nearest_px(camera, points, i, j)
    np.testing.assert_allclose(lines.meeting_px(first, second, i, j, t), wanted, atol=0.02)
    np.testing.assert_allclose(lines.meeting_px(second, first, i, j, t), wanted, atol=0.02)
    assert np.isinf(lines.meeting_px(first, first, i, j, t)).all()
    assert np.isinf(lines.meeting_px(first, second - 2, i, j, t)).all()


@named
def test_where_a_clip_plane_cuts(camera):
    """Points of the surface at the plane's distance, in units of w."""
    flat = flatten(Scene((plane(*PLANES[0]),)))
    rng = np.random.default_rng(3)
    i, j = rng.uniform(0, 240, 400), rng.uniform(0, 320, 400)
    for cut in ({"near": 4.2}, {"far": 4.2}):
        lines = Discontinuities(flat, replace(camera, **cut), SIZE)
        limit = 4.2 if camera.is_parallel else 4.2 / camera.distance
        t = hits(lines, 0, i, j)
        rows, columns = np.meshgrid(np.arange(0, 240, 0.5), np.arange(0, 320, 0.5))
        grid = hits(lines, 0, rows.ravel(), columns.ravel()).reshape(rows.shape)
        down, right = (np.gradient(grid, 0.5, axis=axis) for axis in (1, 0))
        slope = np.hypot(down, right)
        at = np.round(2 * j).astype(int).clip(0, 639), np.round(2 * i).astype(int).clip(0, 479)
        wanted = np.abs(t - limit) / slope[at]
        near = wanted < 30
        assert near.sum() > 10
        found = lines.clip_px(np.zeros(400, int), i, j, t)
        np.testing.assert_allclose(found[near], wanted[near], rtol=0.05)
        np.testing.assert_allclose(lines.slope(np.zeros(400, int), i, j, t), slope[at], rtol=0.05)


def test_nothing_is_cut_where_nothing_is_hit_or_no_plane_set():
    lines = Discontinuities(flatten(Scene((plane(*PLANES[0]),))), PARALLEL, SIZE)
    none = np.full(2, -1)
    i, j, t = np.array([3, 4]), np.array([5, 6]), np.full(2, 4.0)
    assert np.isinf(
        Discontinuities(lines.flat, replace(PARALLEL, near=4.2), SIZE).clip_px(none, i, j, t)
    ).all()
    assert np.isinf(lines.outline_px(none, i, j)).all()
    assert np.isnan(lines.parameter(none, i, j, t)).all()


@named
def test_of_a_spheres_two_hits_the_nearer_to_t(camera):
    center, radius = np.array([0.2, 0.1, -4.0]), 0.8
    flat = flatten(
        Scene((plane((0, 0, 1), (0, 0, -9)), SceneObject(Sphere(tuple(center), radius))))
    )
    lines = Discontinuities(flat, camera, SIZE)
    seen = camera.project(center[None], SIZE)
    i, j = seen.row + np.array([0.0, 9.0, -5.0]), seen.column + np.array([0.0, 4.0, 8.0])
    origin, direction = camera.ray(i, j, SIZE)
    found = []
    for guess in (-1e3, 1e3):
        t = lines.parameter(np.ones(3, int), i, j, np.full(3, guess))
        reached = np.linalg.norm(origin + t[:, None] * direction - center, axis=1)
        np.testing.assert_allclose(reached, radius, rtol=1e-6)
        found.append(t)
    assert (found[0] < found[1]).all()
    np.testing.assert_allclose(np.mean(found, axis=0)[0], seen.parameter[0], rtol=0.05)


CHECKERED = Material(checker=Checker(size=0.4))
FLATTENED = np.array([[1.1, 0, 0.2, 0.1], [0, 0.7, 0, 0.2], [0.3, 0, 1.3, 0], [0, 0, 0, 1.0]])


def checkered_plane() -> SceneObject:
    shape = plane((0.3, 0.5, 1.0), (0, 0, -3)).shape
    return SceneObject(replace(shape, transform=FLATTENED), CHECKERED)


def cells(lines: Discontinuities, i: np.ndarray, j: np.ndarray) -> np.ndarray:
    """The checker cell (n, 3) that the only primitive shows at places of the image."""
    origin, direction = lines.camera.ray(i, j, SIZE)
    t = lines.parameter(np.zeros(i.size, int), i, j, np.zeros(i.size))
    points = origin + t[:, None] * direction
    if len(lines.flat.spheres):
        normal = points - lines.flat.spheres[0, :3]
        matrix = np.eye(4)
        matrix[:3, 3] = lines.flat.spheres[0, :3]
    else:
        a, b, c = (FLATTENED @ [*v, 1.0] for v in checkered_plane().shape.vertices)
        normal = np.broadcast_to(np.cross((b - a)[:3], (c - a)[:3]), points.shape)
        matrix = FLATTENED
    normal = normal * -np.sign((normal * direction).sum(axis=1, keepdims=True))
    linear = np.linalg.inv(matrix)[:3] / 0.4
    nudge = normal @ linear[:, :3].T
    nudge *= 1e-3 / np.linalg.norm(nudge, axis=1, keepdims=True)
    return np.floor(points @ linear[:, :3].T + linear[:, 3] + 0.5 - nudge)


@named
@pytest.mark.parametrize(
    "entry",
    [checkered_plane(), SceneObject(Sphere((0.2, 0.1, -3.0), 0.9), CHECKERED)],
    ids=["plane", "sphere"],
)
def test_a_checker_cell_ends_at_the_distance_of_its_border(camera, entry):
    """Up to there all round the place there is one cell, and a little further there is another."""
    lines = Discontinuities(flatten(Scene((entry,))), camera, SIZE)
    rng = np.random.default_rng(8)
    i, j = rng.uniform(85, 160, 1500), rng.uniform(130, 220, 1500)
    primitive = np.zeros(len(i), int)
    t = lines.parameter(primitive, i, j, np.zeros(len(i)))
    inside = np.isfinite(t)
    i, j, t, primitive = i[inside], j[inside], t[inside], primitive[inside]
    found = lines.checker_px(primitive, i, j, t)
    near = (found > 0.06) & (found < 0.8)
    assert near.sum() > 40
    angles = np.linspace(0, 2 * np.pi, 60, endpoint=False)[:, None]
    here = cells(lines, i[near], j[near])
    for part, same in ((0.9, True), (1.1, False)):
        rows = i[near] + part * found[near] * np.sin(angles)
        columns = j[near] + part * found[near] * np.cos(angles)
        there = cells(lines, rows.ravel(), columns.ravel()).reshape(*rows.shape, 3)
        stays = (there == here).all(axis=(0, 2))
        # All but some at the cells' corners, and where a sphere leaves a layer of cells.
        assert np.mean(stays == same) > 0.94
    behind = plane((0, 0, 1), (0, 0, -50))
    second = Discontinuities(flatten(Scene((behind, entry))), camera, SIZE)
    np.testing.assert_allclose(second.checker_px(primitive + 1, i, j, t), found)
    plain = Discontinuities(flatten(Scene((replace(entry, material=Material()),))), camera, SIZE)
    assert np.isinf(plain.checker_px(primitive, i, j, t)).all()
    assert np.isinf(lines.checker_px(primitive - 1, i, j, t)).all()
    middle, one = (np.full(2, 119.5), np.full(2, 159.5)), np.array([0, -1])
    found = lines.checker_px(one, *middle, np.array([3.0, np.inf]))  # without a warning
    assert np.isfinite(found).tolist() == [True, False]


@named
def test_smooth_normals_and_colours_change_as_their_interpolation_does(camera):
    corners = np.array([(-1.5, -1.0, -4.0), (1.7, -0.6, -3.0), (0.2, 1.4, -5.0)])
    normals = np.array([(0.6, 0, 0.8), (-0.28, 0, 0.96), (0, 0.8, 0.6)])
    colors = np.array([(0.9, 0.2, 0.4), (0.3, 0.8, 0.5), (0.2, 0.6, 0.9)])
    mesh = Mesh(corners, [[0, 1, 2]], normals, colors)
    sphere = SceneObject(Sphere((0, 0, -9), 1.0))
    lines = Discontinuities(flatten(Scene((SceneObject(mesh), sphere))), camera, SIZE)
    i, j = np.array([110.0, 125.0, 131.0]), np.array([150.0, 180.0, 190.0])

    def interpolated(i_: np.ndarray, j_: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        origin, direction = camera.ray(i_, j_, SIZE)
        across = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        t = (corners[0] - origin) @ across / (direction @ across)
        weights = (origin + t[:, None] * direction) @ np.linalg.inv(corners)
        normal = weights @ normals
        return normal / np.linalg.norm(normal, axis=1, keepdims=True), weights @ colors

    step = 1e-3
    ways = [
        [(after - before) / (2 * step) for before, after in zip(*ends, strict=True)]
        for ends in (
            (interpolated(i - step, j), interpolated(i + step, j)),
            (interpolated(i, j - step), interpolated(i, j + step)),
        )
    ]
    (normal_down, color_down), (normal_right, color_right) = ways
    none = np.zeros(3, int)
    slope, unknown = lines.normal_slope(none, i, j)
    wanted = np.linalg.norm(np.hypot(normal_down, normal_right), axis=1)
    np.testing.assert_allclose(slope, wanted, rtol=1e-4)
    assert (unknown > 0).all() and (unknown < 1e-4).all()
    wanted = np.hypot(color_down, color_right) / interpolated(i, j)[1]
    np.testing.assert_allclose(lines.tint_slope(none, i, j), wanted, rtol=1e-4)
    for primitive in (none + 1, none - 1):  # a sphere, and nothing
        assert not np.any(lines.normal_slope(primitive, i, j))
        assert lines.tint_slope(primitive, i, j).tolist() == np.zeros((3, 3)).tolist()


@pytest.mark.parametrize("order", [(0, 1, 2), (1, 2, 0), (2, 1, 0)])
def test_less_is_known_of_a_slivers_normal(order):
    """As its longest edge's square to twice its area, and as its normals differ."""
    corners = np.array([(0.25, 0.5, -3), (0.25, 1.5, -3), (0.24, 0.5, -3)])[list(order)]
    normals = np.array([(0.6, 0, 0.8), (-0.6, 0, 0.8), (0, 0.6, 0.8)])[list(order)]
    for given, varies in ((normals, 1.2), (None, 1.0)):
        flat = flatten(Scene((SceneObject(Mesh(corners, [[0, 1, 2]], given)),)))
        unknown = Discontinuities(flat, PERSPECTIVE, SIZE).normal_slope(*np.zeros((3, 1), int))[1]
        assert unknown == pytest.approx(4 * 2.0**-21 * 100 * varies, rel=1e-3)


@pytest.mark.parametrize(("side", "touched"), [(-1, True), (1, False)])
@pytest.mark.parametrize("order", [(0, 1, 2), (1, 2, 0), (2, 0, 1)])
def test_an_edge_right_behind_the_eye_is_not_touched(side, touched, order):
    corners = np.array([(2e-4, 500, side * 2e-4), (2e-4, -500, side * 2e-4), (-900, 0, side * 9)])
    flat = flatten(Scene((SceneObject(Mesh(corners[list(order)], [[0, 1, 2]])),)))
    lines = Discontinuities(flat, Camera(viewport=(-4, 4, -3, 3)), (32, 24))
    distance = lines.outline_px(np.zeros(1, int), np.array([12]), np.array([22]))
    assert (distance[0] == 0) == touched


def test_cells_of_little_more_than_a_pixel():
    """Cells are 1.5 pixels wide: the border is the one nearest to the pixel itself."""
    camera, size = Camera(viewport=(-0.5, 0.5, -0.375, 0.375)), (32, 24)
    side = 1.5 / 16  # at t = 2, where a pixel is 1/16 of a unit
    wall = SceneObject(plane((0, 0, 1), (0, 0, -2)).shape, Material(checker=Checker(size=side)))
    lines = Discontinuities(flatten(Scene((wall,))), camera, size)
    i, j = np.random.default_rng(4).uniform(9, 20, (2, 40))
    cells = np.stack(camera.image_point(i, j, size), axis=-1) * 2 / side + 0.5
    wanted = 1.5 * np.abs(cells - np.round(cells)).min(axis=1)
    found = lines.checker_px(np.zeros(40, int), i, j, np.full(40, 2.0))
    np.testing.assert_allclose(found, wanted, atol=1e-3)


def test_from_where_on_a_long_triangle_is_rasterized():
    """A millionth of its farthest corner's depth, and what float32 adds to that; however it came
    to be where it is."""
    corners = np.array([(-400, -1, 400), (400, -1, 400), (0, -1, -400)])
    turned = np.array([(0, 0, 1, 30), (0, 1, 0, 0), (-1, 0, 0, -70), (0, 0, 0, 1.0)])
    own = (corners - turned[:3, 3]) @ turned[:3, :3]
    pixel = np.zeros(1, int), np.array([20]), np.array([9])
    for mesh in (Mesh(corners, [[0, 1, 2]]), Mesh(own, [[0, 1, 2]], transform=turned)):
        lines = Discontinuities(flatten(Scene((SceneObject(mesh),))), Camera(), (32, 24))
        for part, cut in ((1.4e-6, True), (1.6e-6, False)):
            distance = lines.clip_px(*pixel, np.array([part * 400]))
            assert (distance[0] == 0) == cut
