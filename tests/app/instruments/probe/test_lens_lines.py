"""The probe writes down how a lens's camera gets from a pixel to its ray."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from read_pixels import BALL, SIZE, line

from lucida.app.instruments.probe.copying import all_lines, as_latex, as_text
from lucida.app.instruments.probe.model import Probe
from lucida.app.instruments.probe.reading import OUTSIDE
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
    np.testing.assert_allclose(
        line(lines, "ideal").value,
        np.ravel(lens.direction(a, b))[: 2 if lens.model == "brown" else 3],
    )
    direction = np.array(line(lines, "direction").value)
    np.testing.assert_allclose(direction, camera.ray(*PIXEL, SIZE).direction)
    own = np.array(line(lines, "camera direction").value)
    np.testing.assert_allclose(camera.basis @ own, direction)
    steps = [one for one in lines if one.key.startswith("step ")]
    assert bool(steps) == (bool(lens.coefficients) and lens.model != "fov")
    if steps:  # it converges: the last step is not off any more
        off = [float(one.name.rpartition(": ")[2].split()[0]) for one in steps]
        assert off[0] > 0.001 and off[-1] < 1e-9 and off == sorted(off, reverse=True)
        wanted = lens.image_point(*lens.direction(a, b))
        np.testing.assert_allclose(wanted, (a, b), atol=1e-12)


@pytest.mark.parametrize("notation", ["book", "code"])
def test_outside_of_the_lens_no_ray_is_written(notation):
    camera = replace(CAMERA, lens=Lens("brown", {"k1": -9.0}))
    reading = Probe(BALL).at((0, 0), camera, SIZE)
    assert reading.is_outside and reading.hit is None
    assert not any(meeting.crossings for meeting in reading.meetings)
    assert [one.key for one in all_lines(reading)][-1] == "outside"
    for text in (as_text, as_latex):
        shown = text(reading, Indexing.LECTURE, notation)
        assert "none" in shown and "nan" not in shown.lower()
    assert "no direction" in OUTSIDE
