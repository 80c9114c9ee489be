"""Views to copy as text, and what is around them when they are pasted."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from any_camera import cameras
from hypothesis import strategies as st

from lucida.app.cameras.reader import read_copied
from lucida.app.cameras.text import Subject
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import MODELS, Lens
from lucida.renderer.scene.model import View

SIZE = (160, 90)
NOW = View(Camera(eye=(9, 9, 9), distance=2.5, near=0.25), fit=True)
BOUNDS = np.array([[x, y, z] for x in (-2, 2) for y in (-1, 2) for z in (-3, 2)], float)


def read_view(text: str, now: View) -> View:
    """The view of a text's camera."""
    return read_copied(text, now).view


views = st.builds(View, cameras(), st.booleans())


@st.composite
def lens_views(draw: st.DrawFn) -> View:
    """Draw a view through a lens of any model."""
    model = draw(st.sampled_from(sorted(MODELS)))
    value = st.floats(0.1, 3) if model == "fov" else st.floats(-0.3, 0.3)
    names = draw(st.sets(st.sampled_from(MODELS[model]))) if MODELS[model] else ()
    names = MODELS[model] if model == "fov" else names
    camera = replace(draw(cameras()), projection="perspective")
    lens = Lens(model, {name: draw(value) for name in names})
    return View(replace(camera, lens=lens), draw(st.booleans()))


def subject(view: View) -> Subject:
    return Subject(view, view.for_size(SIZE), BOUNDS)
