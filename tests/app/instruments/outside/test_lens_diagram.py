"""A lens in the outside view: where its image is, its border, its rays, what it does to a pixel."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lucida.app.instruments.outside.camera_diagram import Content, diagram
from lucida.app.instruments.outside.diagram import Face, Label, RayEnd, Segments
from lucida.app.instruments.outside.frustum import (
    border,
    image_point,
)
from lucida.app.instruments.outside.growing import grown_diagram
from lucida.app.instruments.outside.lens_diagram import OUTSIDE
from lucida.app.instruments.outside.projected import project
from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.app.state.options.outside import OutsideOptions
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens

SIZE = (48, 32)
MARKED = RayEnd((5, 40), 3.0)
BASIS = {"eye": (1.0, 2.0, 3.0), "u": (0.8, 0.0, -0.6), "v": (0.0, 1.1, 0.0), "w": (0.6, 0.0, 0.8)}


def camera(model: str, viewport=(-0.9, 0.9, -0.6, 0.6), **coefficients: float) -> Camera:
    return Camera(**BASIS, distance=1.3, viewport=viewport, lens=Lens(model, coefficients))


WIDE = (-2.6, 2.6, -1.8, 1.8)
CAMERAS = {
    "barrel": camera("brown", k1=-0.15),
    "pincushion": camera("brown", k1=0.3, p1=0.02),
    "narrow fisheye": camera("fisheye", k1=0.05),
    "fisheye": camera("equidistant", WIDE),
    "circle": camera("orthographic", (-1.2, 1.2, -0.8, 0.8)),
    "panorama": camera("equirectangular", (-1.3 * np.pi, 1.3 * np.pi, -0.65 * np.pi, 0.65 * np.pi)),
}
MEETING = ("barrel", "pincushion", "narrow fisheye", "circle")  # rays of the marked pixel
each = pytest.mark.parametrize("name", CAMERAS)


@each
def test_the_border_is_where_the_viewport_or_the_lens_ends(name):
    lens, places = CAMERAS[name], border(CAMERAS[name])
    left, right, bottom, top = lens.viewport
    assert np.isfinite(lens.direction(*places.T)).all()
    on_frame = np.isclose(places, [[left, bottom]]) | np.isclose(places, [[right, top]])
    ends = ~on_frame.any(axis=1)
    assert ends.any() == (name == "circle")
    assert np.isnan(lens.direction(*(1.001 * places[ends]).T)).all()


@each
def test_the_marked_ray_and_the_volume_are_the_lens_s(name):
    lens = CAMERAS[name]
    items = diagram(Content(lens, SIZE, OutsideOptions(), 5.0, [MARKED], MARKED))
    assert all(np.isfinite(getattr(item, "segments", 0.0)).all() for item in items)
    found = {item.name: item for item in items if isinstance(item, Segments)}
    origin, direction = lens.ray(*MARKED.pixel, SIZE)
    np.testing.assert_allclose(found["ray"].segments[0], [origin, origin + 3 * direction])
    assert "image plane" in found
    ends = found["end"].segments[:, 0]
    t = np.linalg.norm(lens.project(ends, SIZE).parameter - 5.0)
    assert t < 1e-9
    assert ("lens" in found) == (name in MEETING)
    if name in MEETING:  # from the pixel to where its ray meets the image plane
        pixel, ideal = found["lens"].segments[0]
        np.testing.assert_allclose(pixel, image_point(lens, *lens.image_point(*MARKED.pixel, SIZE)))
        np.testing.assert_allclose(np.linalg.solve(lens.basis, ideal - lens.eye)[2], -1.3)
        np.testing.assert_allclose(np.cross(ideal - lens.eye, direction), 0, atol=1e-12)
    looking = Camera.look_at((9, 7, 9), (1, 2, 3), fov_y_deg=60)
    assert project(items, OutsideScreen(looking, (300, 200)))


def test_a_pixel_outside_of_the_lens_is_named_and_has_no_ray():
    lens = replace(CAMERAS["barrel"], lens=Lens("brown", {"k1": -0.9}))
    options = OutsideOptions(formula=2.5)
    pixel = RayEnd((0, 0), None)
    items = grown_diagram(Content(lens, SIZE, options, 5.0, [pixel], pixel))
    assert [item.text for item in items if isinstance(item, Label) and item.name == "outside"] == [
        OUTSIDE
    ]
    assert not {"ray", "bundle"} & {item.name for item in items}
    assert all(np.isfinite(item.corners).all() for item in items if isinstance(item, Face))


@each
def test_a_lens_has_no_growing_formula(name):
    content = Content(CAMERAS[name], SIZE, OutsideOptions(formula=3.5), 5.0, (), MARKED)
    assert {"ray", "hit"} <= {item.name for item in grown_diagram(content)}
    assert not any("term" in item.name for item in grown_diagram(content))
