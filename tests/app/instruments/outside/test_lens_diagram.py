"""A lens in the outside view: where its image is, its border, its rays, what it does to a pixel."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lucida.app.instruments.outside.camera_diagram import Content, diagram
from lucida.app.instruments.outside.diagram import Face, Label, RayEnd, Segments
from lucida.app.instruments.outside.frustum import (
    CURVE,
    border,
    ideal_point,
    image_point,
    meets_plane,
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
FLAT = ("barrel", "pincushion", "narrow fisheye")
each = pytest.mark.parametrize("name", CAMERAS)


@each
def test_the_image_is_on_the_plane_which_rays_may_miss(name):
    lens, places = CAMERAS[name], border(CAMERAS[name])
    along = np.linalg.solve(lens.basis, (image_point(lens, *places.T) - lens.eye).T)
    np.testing.assert_allclose(along[2], -lens.distance)
    np.testing.assert_allclose(along[:2].T, places)
    assert meets_plane(lens) == (name in FLAT)
    if name in FLAT:
        ideal = ideal_point(lens, *places.T) - lens.eye
        np.testing.assert_allclose(np.linalg.solve(lens.basis, ideal.T)[2], -lens.distance)
        directions = lens.direction(*places.T)
        np.testing.assert_allclose(np.cross(ideal, directions), 0, atol=1e-12)
        assert ((ideal * directions).sum(axis=1) > 0).all()


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
    if name in FLAT:  # a side of the border is a curve, unlike a pinhole's
        side = found["ideal border"].segments[:CURVE, 0]
        across = np.cross(side[1:] - side[0], side[-1] - side[0])
        assert np.abs(across).max() > 1e-3
        shift = found["lens"].segments[0]
        x, y = lens.image_point(*MARKED.pixel, SIZE)
        np.testing.assert_allclose(shift, [image_point(lens, x, y), ideal_point(lens, x, y)])
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
