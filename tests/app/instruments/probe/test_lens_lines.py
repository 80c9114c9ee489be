"""The probe writes down how a lens's camera gets from a pixel to its ray."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from read_pixels import BALL, SIZE, line

from lucida.app.instruments.probe.copying import all_lines, as_latex
from lucida.app.instruments.probe.model import Probe
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.camera.pixels import Indexing

PIXEL = (19, 37)
CAMERA = Camera(distance=1.3, viewport=(-0.8, 0.8, -0.6, 0.6), u=(1.0, 0.2, 0.0))
LENSES = [
    Lens("brown", {"k1": -0.2, "k2": 0.03}),
    Lens("brown", {"k1": 0.2, "p1": 0.02, "p2": -0.01, "k4": 0.1, "s1": 0.01}),
    Lens("fisheye", {"k1": 0.06, "k3": -0.01}),
    Lens("thin_prism_fisheye", {"k1": 0.06, "p2": 0.01, "sy1": 0.02}),
    Lens("fov", {"omega": 0.9}),
    *(Lens(name) for name in ("brown", "stereographic", "equisolid", "orthographic")),
    *(Lens(name) for name in ("equidistant", "fisheye", "equirectangular", "cylindrical")),
]


@pytest.mark.parametrize("lens", LENSES, ids=lambda lens: lens.model)
def test_the_lines_lead_from_the_pixel_to_the_ray(lens):
    camera = replace(CAMERA, lens=lens)
    reading = Probe(BALL).at(PIXEL, camera, SIZE)
    lines = all_lines(reading)
    a, b = line(lines, "distorted").value
    x, y = camera.image_point(*PIXEL, SIZE)
    np.testing.assert_allclose((a, b), (x / 1.3, -y / 1.3))
    np.testing.assert_allclose(line(lines, "ideal").value, np.ravel(lens.direction(a, b)))
    direction = np.array(line(lines, "direction").value)
    np.testing.assert_allclose(direction, camera.ray(*PIXEL, SIZE).direction)
    distorted = bool(lens.coefficients) and lens.model != "fov"
    assert any(entry.key == "distortion" for entry in lines) is distorted


def test_outside_the_lens_no_ray_is_written():
    camera = replace(CAMERA, lens=Lens("brown", {"k1": -9.0}))
    reading = Probe(BALL).at((0, 0), camera, SIZE)
    assert reading.is_outside and reading.hit is None
    assert not any(meeting.crossings for meeting in reading.meetings)
    assert all_lines(reading)[-1].key == "outside"
    shown = as_latex(reading, Indexing.LECTURE)
    assert "none" in shown and "nan" not in shown.lower()


def test_below_the_middle_the_negative_v_has_brackets():
    lines = all_lines(Probe(BALL).at((40, 37), replace(CAMERA, lens=Lens("brown")), SIZE))
    assert r"-\frac{(-" in line(lines, "distorted").latex_numbers
