"""Pictures as textures: small ones with larger pixels."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from lucida.app.ui.uploads import Uploads


def test_small_pictures_get_larger_pixels():
    made = {}

    def texture(size, components, data, alignment):
        made["picture"] = np.frombuffer(data, np.uint8).reshape(size[1], size[0], components)
        return SimpleNamespace()

    uploads = Uploads(SimpleNamespace(error="GL_NO_ERROR", texture=texture))
    picture = np.arange(12, dtype=np.uint8).reshape(2, 2, 3)
    uploads.put_pixels("small", picture)
    large = made["picture"]
    assert large.shape == (640, 640, 3)
    assert (large[319, 319] == picture[0, 0]).all()
    assert (large[320, 320] == picture[1, 1]).all()
    uploads.put_pixels("large", np.zeros((1, 700, 3), np.uint8))
    assert made["picture"].shape == (1, 700, 3)
