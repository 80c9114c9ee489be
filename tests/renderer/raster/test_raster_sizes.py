"""Images of any size, and of scenes that change."""

import gc
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from raster_scenes import CAMERAS, SIZE, WIDE, agrees, square, still_life

from lucida.renderer.camera.camera import Camera
from lucida.renderer.compare.raster_and_ray import CHANNELS
from lucida.renderer.raster import prepare
from lucida.renderer.scene.model import (
    Mesh,
    Scene,
    SceneObject,
    Sphere,
)
from lucida.renderer.system.errors import LucidaError


def test_odd_sizes_and_single_pixels(rasterizer):
    for size in ((1, 1), (1, 37), (61, 1), (17, 5)):
        agrees(rasterizer, still_life(), CAMERAS["from above"], size)


def test_sizes_and_scenes_can_change_at_every_frame_and_leave_nothing(rasterizer):
    """moderngl keeps in ctx.objects what Python has dropped without releasing it."""
    camera = CAMERAS["from above"]
    with rasterizer.current() as gl:
        gl.gc_mode = "context_gc"
    for k in range(12):
        if k % 3 == 0:
            rasterizer.set_scene(still_life())
        size = (20 + k, 40 - k)
        assert rasterizer.draw(camera, size).color.size == size
        assert rasterizer.render(camera, size[::-1], ("id",)).id.shape == size
    gc.collect()
    left = [name for thing in gl.objects if (name := type(thing).__name__) != "InvalidObject"]
    gl.gc_mode = None
    assert left == []


def test_a_scene_that_is_refused_leaves_the_old_one(rasterizer):
    rasterizer.set_scene(Scene((SceneObject(Sphere((0, 0, -5))),)))
    too_far = np.eye(4) * 1e12
    too_far[3, 3] = 1
    huge = Mesh(square(1).vertices * 1e6, square(1).faces, transform=too_far)
    with pytest.raises(LucidaError, match="object 0: its transform is too large"):
        rasterizer.set_scene(Scene((SceneObject(huge),)))
    assert rasterizer.render(Camera(), (1, 1)).id[0, 0] == 0


def test_objects_in_more_than_one_row_of_their_table_keep_their_ids(rasterizer):
    """More than one row of a table: 8 texels an object, 4096 a row."""
    n = 30
    spheres = [
        SceneObject(Sphere((x - n / 2 + 0.5, y - n / 2 + 0.5, -n), 0.4), name=f"{x} {y}")
        for y in range(n)
        for x in range(n)
    ]
    rasterizer.set_scene(Scene(tuple(spheres)))
    ids = rasterizer.render(Camera(projection="parallel", viewport=(-15, 15, -15, 15)), (n, n)).id
    np.testing.assert_array_equal(ids, np.arange(n * n).reshape(n, n)[::-1])


def test_triangles_in_more_than_one_row_of_their_table_keep_their_numbers(rasterizer):
    """More than one row of the table of triangles."""
    n = 70
    y, x = np.mgrid[: n + 1, : n + 1] - n / 2
    corners = np.stack([x, y, np.full_like(x, -1)], axis=-1).reshape(-1, 3)
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    faces = np.stack([[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]], axis=0)
    faces = faces.transpose(2, 0, 1).reshape(-1, 3)
    rasterizer.set_scene(Scene((SceneObject(Mesh(corners, faces)),)))
    camera = Camera(projection="parallel", viewport=(-35 + 0.2, 35 + 0.2, -35, 35))
    frame = rasterizer.render(camera, (n, n), ("primitive", "depth"))
    np.testing.assert_allclose(frame.depth[:, :-1], 1, rtol=1e-6)
    squares = np.arange(n * n).reshape(n, n)[::-1]
    np.testing.assert_array_equal(frame.primitive[:, :-1], 2 * squares[:, :-1])


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ({"size": (0, 5)}, "size"),
        ({"size": (20000, 5)}, "size"),
        ({"size": "big"}, "size"),
        ({"channels": ("colour",)}, "channel"),
        ({"samples": 5}, "samples"),
    ],
)
def test_wrong_arguments_are_one_line(rasterizer, arguments, told):
    with pytest.raises(LucidaError, match=told) as caught:
        rasterizer.render(**{"camera": WIDE, "size": (4, 4), **arguments})
    assert "\n" not in str(caught.value)


def test_a_scene_prepared_in_another_thread_is_drawn_the_same(rasterizer):
    scene = still_life()
    rasterizer.set_scene(scene)
    expected = rasterizer.render(WIDE, SIZE, CHANNELS)
    with ThreadPoolExecutor(1) as pool:
        prepared = pool.submit(prepare, scene).result()
    rasterizer.set_scene(Scene(()))
    rasterizer.set_scene(scene, prepared)
    again = rasterizer.render(WIDE, SIZE, CHANNELS)
    for channel in CHANNELS:
        np.testing.assert_array_equal(again.channel(channel), expected.channel(channel))
