"""Images as files and numbers keep them, against arithmetic by hand."""

from __future__ import annotations

import numpy as np
from both_lectures import first_lecture

from lucida.app.instruments.laboratory import kinds
from lucida.app.instruments.laboratory.stored import kept
from lucida.renderer.images import to_srgb8
from lucida.renderer.images.display import from_srgb
from lucida.renderer.trace import Tracer


def test_a_bitmap_of_a_picture_that_was_exposed():
    """At two stops, what has a quarter of the threshold's light is white."""
    light = float(from_srgb(np.uint8(128))) * np.array([[[0.26] * 3, [0.24] * 3]])
    assert kept(light, kinds.BITMAP, 2.0).tolist() == [[[255] * 3, [0] * 3]]
    assert kept(4 * light, kinds.BITMAP).tolist() == [[[255] * 3, [0] * 3]]
    assert kept(4 * light, kinds.BITMAP, 0.0, -1.0).tolist() == [[[to_srgb8(0.5)] * 3, [0] * 3]]


def test_floats_keep_what_8_bits_lose(color):
    np.testing.assert_array_equal(kept(color, kinds.COLOR), kept(color, kinds.FLOAT))
    np.testing.assert_array_equal(kept(color, kinds.FLOAT, 0.0, -2.0), to_srgb8(color, -2.0))
    # What was clipped stays one value: 1 darkened by two stops.
    lost = (color > 1).all(axis=2)
    assert lost.any() and not lost.all()
    assert (kept(color, kinds.COLOR, 0.0, -2.0)[lost] == to_srgb8(0.25)).all()


def test_the_lecture_s_bright_scene_is_clipped_in_part_and_its_highlight_returns():
    step = [one for one in first_lecture().builds if _page(one) == "exposure"][-1]
    with Tracer(step.scene) as tracer:
        color = tracer.render(step.view.for_size((60, 60)), (60, 60)).color[..., :3]
    after_ev = step.changes["laboratory"]["after_ev"]
    lost = (color > 1).all(axis=2)
    assert 0.01 < lost.mean() < 0.3
    flat, bright = (kept(color, kind, 0.0, after_ev)[lost] for kind in (kinds.COLOR, kinds.FLOAT))
    assert flat.max() == to_srgb8(2.0**after_ev)  # white, darkened
    assert len(np.unique(bright)) > 20 and bright.max() > flat.max() + 50
    assert (to_srgb8(color, after_ev) == 255).mean() < 0.001  # no longer clipped


def _page(step) -> str | None:
    return step.changes.get("laboratory", {}).get("page")
