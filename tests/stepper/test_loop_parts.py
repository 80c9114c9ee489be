"""The functions that the loops call: bounding boxes, objects, and lines that meet boxes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from recorded_runs import TWO_BALLS

from app.explaining.projected import EVERYTHING, NOTHING, mesh_extent, sphere_extent
from app.stepper.loop_parts import Model, bounding_box, meets_box
from renderer.camera import Camera
from renderer.scene import shapes
from renderer.scene.model import Scene, SceneObject, Sphere
from renderer.trace import Tracer


def outline(scene: Scene, camera: Camera) -> tuple[int, int, int, int]:
    """First and last row and column that the tracer sees anything in."""
    with Tracer(scene) as tracer:
        rows, columns = np.nonzero(tracer.render(camera, (240, 180), ("id",)).id >= 0)
    return rows.min(), rows.max(), columns.min(), columns.max()


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize("shape", ["sphere", "torus"])
def test_boxes_fit_tightly(shape: str, projection: str) -> None:
    """Also in a skewed basis, seen from the side."""
    one = Sphere((0.4, 0.3, -4), 0.8) if shape == "sphere" else shapes.torus(0.9, 0.3)
    if not isinstance(one, Sphere):
        one = shapes.translate(shapes.rotate(one, (50, 20, 0)), (0.2, 0.1, -4))
    scene = Scene((SceneObject(one),))
    camera = Camera(
        (0.1, 0, 0.5), (1, 0.2, 0.1), (-0.3, 1.1, 0), (0.2, 0.1, 0.9), 1.2,
        (-1, 1, -0.8, 0.7) if projection == "perspective" else (-2.5, 2.5, -2, 2), projection,
    )  # fmt: skip
    rows, columns = bounding_box(Model(scene).objects[0], camera, (240, 180))
    top, bottom, left, right = outline(scene, camera)
    assert 0 < left < right < 239 and 0 < top < bottom < 179
    for first, second in ((rows.start, top), (columns.start, left)):
        assert 0 <= second - first <= 1
    for first, second in ((rows.stop - 1, bottom), (columns.stop - 1, right)):
        assert 0 <= first - second <= 1


def test_boxes_of_what_reaches_behind_the_eye() -> None:
    camera = Camera.canonical()
    floor = shapes.translate(shapes.rectangle(4, 40), (0, -1, 0))
    rows, columns = bounding_box(Model(Scene((SceneObject(floor),))).objects[0], camera, (240, 180))
    # y = -1 is seen below the horizon down to the image's lower edge, the far end at z = -20.
    assert rows.stop == 180 and columns == range(240)
    assert rows.start == math.ceil((0.5 + 1 / 20) * 180 - 0.5)
    assert sphere_extent(np.array([0, 0, 3.0]), 1, camera) == NOTHING
    assert sphere_extent(np.array([0, 0, 0.5]), 1, camera) == EVERYTHING
    behind = np.array([[0, 0, 1.0], [1, 0, 2], [0, 1, 3]])
    assert mesh_extent(behind, np.array([[0, 1, 2]]), camera) == NOTHING
    clipped = Camera(near=2, far=4)
    assert sphere_extent(np.array([0, 0, -1.0]), 0.5, clipped) == NOTHING
    assert sphere_extent(np.array([0, 0, -5.0]), 0.5, clipped) == NOTHING


def test_an_object_has_a_name_a_box_and_its_own_triangles() -> None:
    box = shapes.translate(shapes.box((1, 2, 3)), (5, 0, 0))
    scene = Scene((*TWO_BALLS.objects, SceneObject(box), SceneObject(box, name="its twin")))
    far, _, one, twin = Model(scene).objects
    assert (far.name, one.name, twin.name) == ("far", "object 2", "its twin")
    assert (far.low, far.high) == ((-2, -2, -7), (2, 2, -3))
    assert (twin.low, twin.high) == ((4.5, -1, -1.5), (5.5, 1, 1.5))
    assert far.vertices.shape == far.faces.shape == (0, 3)
    for thing in (one, twin):
        assert thing.faces.shape == (12, 3) and len(thing.vertices) == thing.faces.max() + 1
        assert (np.abs(thing.vertices - (5, 0, 0)) == (0.5, 1, 1.5)).all()


def test_a_line_meets_a_box_where_no_axis_parts_them() -> None:
    """Touching it, too; flat boxes, and lines along an axis. No plane of two axes parts them: the
    separating axis theorem."""
    rng = np.random.default_rng(5)
    met = 0
    for _ in range(3000):
        corners, origin, direction = rng.integers(-2, 3, (3, 2, 3))
        low, high = corners.min(axis=0), corners.max(axis=0)
        origin, direction = origin[0], direction[0]
        if not direction.any():
            continue
        # Of twice the box, so that its middle is a whole number.
        parted = np.abs(np.cross(2 * origin - low - high, direction))
        half = high - low
        reach = np.abs(direction) @ np.array(
            [[0, *half[[2, 1]]], [half[2], 0, half[0]], [half[1], half[0], 0]]
        )
        expected = bool((parted <= reach).all())
        box = tuple(map(float, low)), tuple(map(float, high))
        found = meets_box(*box, tuple(map(float, origin)), tuple(map(float, direction)))
        assert found is expected
        met += expected
    assert 500 < met < 2500
