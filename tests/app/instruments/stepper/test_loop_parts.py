"""The functions that the loops call: objects, and lines that meet boxes."""

from __future__ import annotations

import numpy as np
from recorded_runs import TWO_BALLS

from lucida.app.instruments.stepper.loop_parts import Model, meets_box
from lucida.renderer.scene import shapes
from lucida.renderer.scene.model import Scene, SceneObject


def test_an_object_has_a_name_a_box_and_its_own_triangles() -> None:
    box = shapes.transformed(shapes.box((1, 2, 3)), shapes.placement((5, 0, 0)))
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
