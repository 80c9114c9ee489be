"""The promise: what the rasterizer, the packets and the reference draw is the same."""

from __future__ import annotations

import atexit
from functools import cache

from lucida import Camera, Rasterizer, Tracer
from lucida.renderer.compare.raster_and_ray import CHANNELS, compare_frames
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Scene


@cache
def one_rasterizer() -> Rasterizer:
    """Return a rasterizer for all scenes: its shaders compile once."""
    rasterizer = Rasterizer(Scene(()))
    atexit.register(rasterizer.release)
    return rasterizer


def agree(scene: Scene, camera: Camera, size=(96, 64)):
    """The frames of all three renderers, of which each two agree."""
    rasterizer = one_rasterizer()
    rasterizer.set_scene(scene)
    raster = rasterizer.render(camera, size, channels=CHANNELS)
    with Tracer(scene) as tracer:
        packets = tracer.render(camera, size, channels=CHANNELS)
    with Tracer(scene, method="reference") as tracer:
        single = tracer.render(camera, size, channels=CHANNELS)
    flat = flatten(scene)
    for first, second in ((raster, packets), (raster, single), (single, packets)):
        result = compare_frames(flat, camera, size, first, second)
        assert result.unexplained == 0, result.summary()
        assert result.agree > 0.97 * result.pixels, result.summary()
    return raster, packets, single
