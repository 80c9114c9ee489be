"""The rays that the outside view shows, with their ends as far as those are known."""

from __future__ import annotations

from app.host.view import Host
from app.outside.diagram import RayEnd
from app.outside.frustum import bundle_pixels
from app.outside.hits import RayHits, RayQuery
from app.outside.looking import ray_pixel
from app.outside.options import OutsideOptions
from renderer.camera import Camera


def ray_ends(
    hits: RayHits, host: Host, camera: Camera, size: tuple[int, int]
) -> tuple[RayEnd | None, list[RayEnd]]:
    """The marked pixel's ray and the bundle's."""
    both, state = host.renderers, host.state
    options = state.of(OutsideOptions)
    pixel = ray_pixel(host) if options.ray else None
    pixels = [(int(i), int(j)) for i, j in bundle_pixels(size, options.bundle)]
    asked = pixels + ([pixel] if pixel is not None else [])
    question = RayQuery(state.scene, camera, size, tuple(asked))
    tracer = both.live.tracer_of(state.scene) if asked else None
    known = hits.ask(question, tracer)
    bundle = [RayEnd(entry, known[entry]) for entry in pixels]
    if pixel is None:
        return None, bundle
    seen = both.depth_at(state, pixel)
    return RayEnd(pixel, known[pixel] if seen is None else seen), bundle
