"""A picture is drawn again only where something has changed: it is always that of a new one."""

from __future__ import annotations

import numpy as np

from lucida.app.images.placement import Placement
from lucida.app.images.shown import DepthBounds, Pictures, whole
from lucida.renderer.raster.display import Look
from lucida.renderer.raster.resources import Owner, new_texture

SIZE = (6, 4)
LOOKS = (
    Look(),
    Look(exposure_ev=1.0),
    Look(transfer="linear"),
    Look("depth"),
    Look("normal"),
    Look("id"),
)
PLACEMENTS = (
    whole(SIZE),
    Placement(SIZE, (12, 8), 2.0, (0, 0), (12, 8)),
    Placement(SIZE, (12, 8), 4.0, (-3, -2), (24, 16)),
    Placement(SIZE, (12, 8), 4.0, (-5, -2), (24, 16)),
    Placement(SIZE, (12, 8), 1.5, (1, 0), (9, 6)),
)


def test_whatever_changes_the_picture_is_that_of_a_new_one(gl):
    rng, owner = np.random.default_rng(20261124), Owner()

    def texture(size, values):
        values = np.asarray(values)
        made = owner.own(new_texture(gl, size, values.shape[-1], values.dtype))
        made.write(np.ascontiguousarray(values))
        return made

    def channels():
        shape = (SIZE[1], SIZE[0])
        light, surface = rng.random((2, *shape, 4)).astype(np.float32)
        ids = rng.integers(-1, 5, (*shape, 1)).astype(np.int32)
        light, surface = texture(SIZE, light), texture(SIZE, surface)
        return {"color": light, "depth": surface, "normal": surface, "id": texture(SIZE, ids)}

    bounds = texture((1, 1), np.array([[[0.1, 0.9]]], np.float32))
    shown, seen = Pictures(gl), set()
    current, content = channels(), 0
    given = {"look": LOOKS[0], "placement": PLACEMENTS[0]}
    depths = DepthBounds(bounds)
    for step in range(120):
        kind = str(rng.choice(["look", "placement", "channels", "depths"]))
        if kind == "look":
            given["look"] = LOOKS[rng.integers(len(LOOKS))]
        elif kind == "placement":
            given["placement"] = PLACEMENTS[rng.integers(len(PLACEMENTS))]
        elif kind == "channels":  # the same textures, with another image in them
            for name, made in channels().items():
                current[name].write(made.read())
            content += 1
        else:
            bounds.write(np.sort(rng.random(2)).astype(np.float32))
            depths = DepthBounds(bounds)
        given["source"] = current[given["look"].channel], content
        one = shown.picture("kept", depths=depths, **given)
        new = shown.picture(f"new {step}", depths=depths, **given)
        assert one.texture.size == new.texture.size
        assert one.texture.read() == new.texture.read(), (step, kind, given)
        again = shown.picture("kept", depths=depths, **given)
        assert again.texture is one.texture and again.made is one.made
        seen.add(new.texture.read())
        if step % 20 == 19:
            shown.begin_frame()
    assert len(seen) > 60
    shown.release()
    owner.release()
