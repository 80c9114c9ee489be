"""The stepped rasterization: the image of the other loops and of the renderers, triangle by
triangle; what its parts say of a pixel."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from recorded_runs import TWO_BOXES, recorded
from textured import noise, wall

from lucida.app.instruments.stepper.loop_parts import Model
from lucida.app.instruments.stepper.loops import image_order, rasterization
from lucida.app.instruments.stepper.model import moment_at
from lucida.app.instruments.stepper.raster_parts import (
    Corner,
    box_around,
    edge,
    project,
    t_of,
    triangles,
)
from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene import shapes
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Mesh, PointLight, Scene, SceneObject, Sphere
from lucida.renderer.scene.texture import Texture

SIZE = (20, 15)


def turned(mesh: Mesh, rotate_deg: tuple[float, float, float]) -> Mesh:
    return shapes.transformed(mesh, shapes.placement(rotate_deg=rotate_deg))


LIGHT = (PointLight((2, 3, 1)),)
# Its diagonal runs through the middles of pixels of a square image.
SQUARE = Scene(
    (
        SceneObject(
            shapes.transformed(
                turned(shapes.rectangle(1.0, 1.0), (90, 0, 0)), shapes.placement((0, 0, -1))
            )
        ),
    ),
    LIGHT,
    background=(1.0, 0.0, 1.0),
)
SQUARE_SEEN = Camera(viewport=(-0.4, 0.4, -0.4, 0.4))


def test_spheres_are_there_before_the_triangles() -> None:
    """In front of a wall, and half in it: the depth buffer holds both."""
    wall = shapes.transformed(shapes.box((4.0, 4.0, 1.0)), shapes.placement((0, 0, -4)))
    ball = SceneObject(Sphere((0.4, 0.1, -3.4), 0.7), Material((0.1, 0.9, 0.1)))
    scene = Scene((SceneObject(wall), ball), LIGHT)
    run = recorded(scene, rasterization)
    begun = moment_at(run, 2)
    drawn = (begun.canvas != scene.background).any(axis=2)
    (depth,) = run.changes["depth"][1]
    assert np.array_equal(drawn, np.isfinite(depth.array) & drawn) and drawn.any()


# What is cut off.


@pytest.mark.parametrize("clip", [(None, None), (2.0, None), (None, 9.0), (1.5, 6.0)])
@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_triangles_that_reach_behind_the_eye_or_the_clip_planes(clip, projection) -> None:
    """A floor under the eye, from far behind it to far before, and a long beam through near and
    far: clipped, not torn, not turned round."""
    checked = Material((0.8, 0.8, 0.8))
    things = (
        shapes.transformed(shapes.rectangle(14.0, 60.0), shapes.placement((0.31, -1, 3))),
        turned(
            shapes.transformed(shapes.box((0.4, 0.5, 30.0)), shapes.placement((0.5, 0.2, 0))),
            (5, 20, 3),
        ),
    )
    scene = Scene(tuple(SceneObject(thing, checked) for thing in things), LIGHT)
    model = Model(scene)
    side = 3.0 if projection == "parallel" else 0.5
    camera = Camera(
        (0.013, 0.21, 0.37), (1, 0.02, 0.01), (-0.03, 1.01, 0.2), (0.02, -0.1, 1),
        1.25, (-side, side, -side, side), projection, near=clip[0], far=clip[1],
    )  # fmt: skip
    pieces = list(triangles(model, camera))
    assert not all(piece.is_whole for piece in pieces)
    t_min, _ = camera.t_range
    for piece in pieces:
        corners = project(piece, camera, SIZE)
        at_corners = zip(corners, np.eye(3).tolist(), strict=True)
        t = np.array([t_of(corner.z, piece, *weights) for corner, weights in at_corners])
        assert np.isfinite(corners).all() and (t >= t_min - 1e-12).all()
        whole = model.index.vertices[model.flat.faces[piece.primitive]]
        np.testing.assert_allclose(np.array(piece.shares) @ whole, piece.points, atol=1e-9)
    ours, by_rays = (order(model, camera, SIZE).array for order in (rasterization, image_order))
    np.testing.assert_allclose(ours, by_rays, atol=1e-8)
    assert (ours != np.array(model.background)).any(axis=2).sum() > 20


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_holes_are_seen_through(projection) -> None:
    """As by the other loop's rays; through a wall that near cuts, askew, at what is behind it."""
    texels = np.dstack([noise(7, 5), noise(7, 5, 2)[..., :1]])
    holed = Material(texture=Texture(texels), cutout=0.5)
    walls = [turned(wall(Texture(texels), z=0.0), (0, turn, 0)) for turn in (75, 0)]
    walls = [
        shapes.transformed(one, shapes.placement((0, 0, -2 - k))) for k, one in enumerate(walls)
    ]
    scene = Scene(
        tuple(SceneObject(one, holed) for one in walls), LIGHT, background=(1.0, 0.0, 1.0)
    )
    side = 2.0 if projection == "parallel" else 0.7
    camera = Camera(projection=projection, viewport=(-side, side, -side, side), near=1.0)
    model = Model(scene)
    ours, by_rays = (order(model, camera, SIZE).array for order in (rasterization, image_order))
    np.testing.assert_allclose(ours, by_rays, atol=1e-8)
    seen = (ours != np.array(model.background)).any(axis=2).mean()
    assert 0.4 < seen < 0.95  # of what fills the image without holes


# Edge functions.


def test_edge_functions_say_where_a_pixel_is() -> None:
    a, b, c = Corner(1, 1, 0.5), Corner(9, 2, 0.25), Corner(3, 8, 1.0)
    area = edge(a, b, c)
    assert area == edge(b, c, a) == edge(c, a, b) == 8 * 7 - 1 * 2
    assert edge(b, a, c) == -area  # the other winding
    for p in np.random.default_rng(2).uniform(-50, 50, (200, 2)).tolist():
        assert edge(a, b, p) == -edge(b, a, p)  # to the last bit
    for p, inside in (((4, 3), True), ((8, 7), False), ((0.5, 0.5), False), ((1, 1), True)):
        shares = edge(b, c, p) / area, edge(c, a, p) / area, edge(a, b, p) / area
        assert sum(shares) == pytest.approx(1)
        assert (min(shares) >= 0) == inside
        place = np.array(shares) @ [corner[:2] for corner in (a, b, c)]
        np.testing.assert_allclose(place, p)


def test_no_pixel_is_lost_between_two_triangles() -> None:
    """The diagonal of a square runs through the middles of pixels: one of the two takes each."""
    model = Model(SQUARE)
    for tilt in (0.0, 0.1, 1 / 3):
        camera = replace(SQUARE_SEEN, v=(tilt, 1, 0))
        for size in ((9, 9), (16, 16), (13, 7)):
            canvas = rasterization(model, camera, size).array
            assert not (canvas == (1.0, 0.0, 1.0)).all(axis=2).any()


def test_the_box_of_a_triangle_is_its_corners() -> None:
    size = (10, 8)
    corners = Corner(1.6, 2.6, 1), Corner(4.4, 2.7, 1), Corner(2.5, 5.5, 1)
    assert box_around(*corners, size) == (range(3, 6), range(2, 4))
    beside = [corner._replace(x=corner.x + 20) for corner in corners]
    assert box_around(*beside, size) == (range(0), range(0))
    from_its_edge = Corner(0, 0, 1), Corner(4, 4, 1), Corner(8, 8, 1)
    assert box_around(*from_its_edge, size) == (range(0), range(0))
    point = Corner(2.5, 2.5, 1)
    assert box_around(point, point, point, size) == (range(0), range(0))
    for width, columns in ((1e-12, range(0)), (1e-9, range(9))):  # to its length
        sliver = Corner(0, 0, 1), Corner(9, 8, 1), Corner(9, 8 + width, 1)
        assert box_around(*sliver, size)[1] == columns
    for x, y in ((3000, 0), (0, 3000)):  # to that, not to its place
        sliver = Corner(x, y, 1), Corner(x + 9, y + 8, 1), Corner(x + 9, y + 8 + 1e-9, 1)
        assert box_around(*sliver, (4000, 4000))[1] == range(x, x + 9)


# Steps.


def test_a_moment_knows_its_triangle_and_whether_the_pixel_is_inside() -> None:
    run = recorded(TWO_BOXES, rasterization)
    tested = next(n for n, line in enumerate(run.source.lines) if "ec = edge" in line)
    steps = [step + 1 for step, line in enumerate(run.lines) if line == tested]
    seen = set()
    for step in steps[:: max(1, len(steps) // 60)]:
        now = moment_at(run, step)
        assert now.triangle is not None and now.corners is not None and now.pixel is not None
        assert now.ray is None
        assert now.corners == project(now.triangle, Camera.canonical(), SIZE)
        inside = min(one.value for one in now.variables if one.name in ("ea", "eb", "ec")) >= 0
        line = run.source.lines[moment_at(run, step + 1).line]
        assert line.lstrip().startswith("z = ") == inside
        seen.add(inside)
    assert seen == {True, False}
    assert moment_at(run, int(run.object_steps[0])).corners is None


def test_a_pixel_on_an_edge_is_inside_and_its_test_gives_the_t_that_is_written() -> None:
    twice_as_far = replace(SQUARE_SEEN, eye=(0, 0, 1), viewport=(-0.2, 0.2, -0.2, 0.2))
    run = recorded(SQUARE, rasterization, twice_as_far, (9, 9))
    inside = run.source.lines.index(next(one for one in run.source.lines if " z = " in one))
    assert run.lines.count(inside) > 81
    t = run.changes["t"][1]
    written = [value for *_, value in run.changes["depth"][1][0].log]
    assert len(written) == 81 and np.isin(written, t).all()
