"""A photograph taken through a lens, and what a pinhole in its place would have seen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from trace_reference import closest

from lucida import load_scene
from lucida.app.images.photograph.model import can_undistort, undistorting, with_photograph
from lucida.app.images.photograph.reading import DecodedPhotograph, without_lens
from lucida.app.state.app_state import AppState
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Mesh, Scene, SceneObject, View

SIZE = (96, 64)
WALL = Mesh([[-20, -20, -3], [20, -20, -3], [20, 20, -3], [-20, 20, -3]], [[0, 1, 2], [0, 2, 3]])
FLAT = flatten(Scene((SceneObject(WALL),)))
LENSES = [
    Lens("brown", {"k1": -0.2, "p1": 0.01}),
    Lens("brown", {"k1": 0.3}),
    Lens("fisheye", {"k1": 0.02}),
]


def taken(camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """A photograph of a wall of waves, by the reference: uint8 (height, width, 4)."""
    origin, direction = (part.reshape(-1, 3) for part in camera.rays(size))
    hit = origin + closest(FLAT, origin, direction).t[:, None] * direction
    wave = np.sin(1.5 * hit[:, 0]) * np.cos(1.2 * hit[:, 1])
    gray = np.rint(127.5 + 120 * wave).astype(np.uint8).reshape(size[1], size[0], 1)
    return np.concatenate([gray, gray, gray, np.full_like(gray, 255)], axis=2)


def shown(lens: Lens) -> AppState:
    camera = Camera((0.1, 0.2, 0.5), distance=1.1, viewport=(-0.7, 0.5, -0.45, 0.35), lens=lens)
    state = AppState.for_scene(load_scene("still-life")).with_view(
        View(camera, False, (camera, SIZE))
    )
    return with_photograph(state, "/photograph.png")


@pytest.mark.parametrize("lens", LENSES, ids=lambda lens: f"{lens.model} {lens.coefficients}")
def test_an_undistorted_photograph_lines_up_with_the_pinhole_s_image(lens):
    state = shown(lens)
    seen = undistorting(state, (1, 1))
    photograph = DecodedPhotograph(taken(state.camera, SIZE), SIZE)
    flat = without_lens(photograph, seen.options.photograph.distorted)
    assert seen.camera.lens is None and seen.view.own_size == flat.size
    wanted = taken(seen.camera, flat.size)
    inside = flat.pixels[..., 3] == 255
    assert inside.mean() > 0.9
    off = np.abs(flat.pixels[..., 0].astype(int) - wanted[..., 0])
    assert off[inside].max() <= 2
    moved = np.abs(flat.pixels[:, 1:, 0].astype(int) - wanted[:, :-1, 0])
    assert moved[inside[:, 1:]].max() > 6  # a pixel's shift would be found


def test_with_the_lens_again_the_camera_stays_where_it_was_moved():
    state = shown(LENSES[0])
    assert can_undistort(state)
    seen = undistorting(state, (1, 1))
    assert can_undistort(seen)
    back = undistorting(seen, (1, 1))
    assert back.camera == state.camera and back.view.own_size == SIZE
    assert back.options.photograph == state.options.photograph
    moved = undistorting(seen.with_camera(replace(seen.camera, eye=(1.0, 2.0, 3.0))), (1, 1))
    assert moved.camera == replace(state.camera, eye=(1.0, 2.0, 3.0))
    other = with_photograph(seen, "/another.png")
    assert other.options.photograph.distorted is None
    assert not can_undistort(shown(LENSES[0]).with_camera(state.camera.pinhole))
