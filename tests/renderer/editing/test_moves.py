"""Moving objects and lights: where they go, and how that is written."""

from __future__ import annotations

import numpy as np
import pytest
from random_edits import item, table

from lucida.renderer.editing import changing, moving
from lucida.renderer.system.errors import LucidaError


@pytest.mark.parametrize("seed", range(5))
def test_a_moved_object_is_where_the_vector_puts_it(scene, seed):
    rng = np.random.default_rng(seed)
    box, way = item(scene, "box"), rng.normal(size=3)
    scene = changing.set_field(scene, [box], "rotate_deg", rng.uniform(-400, 400, 3))
    moved = moving.shift(scene, [box], way)
    was, now = (one.objects[2].shape.transform for one in (scene, moved))
    np.testing.assert_allclose(now[:3, 3], was[:3, 3] + way, atol=1e-9)
    np.testing.assert_array_equal(now[:3, :3], was[:3, :3])


def test_what_a_move_leaves_alone_stays_as_it_is_written(scene):
    box, before = item(scene, "box"), table(scene, "box")
    moved = changing.table_of(moving.shift(scene, [box], (0, 0.5, 0)), box)
    assert moved == {**before, "translate": [0.8, 0.5, 0]}
    same = moving.shift(scene, [box, item(scene, "ball")], (0, 0, 0))
    assert changing.table_of(same, box) == before


@pytest.mark.parametrize("way", [(0, np.nan, 0), (1, 2)])
def test_what_is_no_vector_is_refused(scene, way):
    with pytest.raises(LucidaError, match="finite"):
        moving.shift(scene, [item(scene, "box")], way)


def test_spheres_and_lights_move_by_their_own_numbers(scene):
    ball, sun, lamp = (
        item(scene, name) for name in ("ball", "directional light 0", "point light 1")
    )
    moved = moving.shift(scene, [ball, sun, lamp], (1, 0, 0))
    for name, field in (("ball", "center"), ("point light 1", "position")):
        now, was = table(moved, name)[field], table(scene, name)[field]
        assert now == pytest.approx([was[0] + 1, *was[1:]])
    assert table(moved, "directional light 0") == table(scene, "directional light 0")
    assert scene.objects[0] is moved.objects[0]
    bounds = moving.bounds_of(scene, [ball, lamp])
    np.testing.assert_allclose(bounds, [[-1.3, -0.6, -0.6], [2, 3, 2]])
    assert moving.bounds_of(scene, [sun]) is None
