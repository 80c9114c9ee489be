"""Pictures of a lecture's page in words: what they say is what is drawn. No browser."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from option_changes import with_options

from lucida.app.state.app_state import AppState
from lucida.app.web.lecture.described import MOST_NAMED, alternative
from lucida.app.web.lecture.drawn import paper
from lucida.app.web.lecture.mathml import inline
from lucida.app.web.lecture.page import Still, page
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.editing import objects
from lucida.renderer.scene import Scene, View

CAMERA = Camera(eye=(0, 0, 5), viewport=(-0.5, 0.5, -0.5, 0.5))


def scene_of(places: dict[str, tuple[float, float, float]]) -> Scene:
    scene = Scene((), view=View(CAMERA, fit=False))
    tables = [
        objects.new_table(scene, "sphere", at) | {"name": name} for name, at in places.items()
    ]
    return objects.add(scene, *tables)[0]


SCENE = scene_of({"right": (1, 0, 0), "left": (-1, 0, 0), "behind": (0, 0, 9), "above": (0, 9, 0)})


def told(view: str = "ray", scene: Scene = SCENE, camera: Camera = CAMERA, **options) -> str:
    """Return the text of a view's picture, in which the image has 5 x 5 pixels."""
    state = AppState.for_scene(scene, View(camera, fit=False))
    state = with_options(state, images={"resolution": (5, 5)}, **options)
    return alternative(view, SimpleNamespace(scene=scene, views=(view,)), state)


def test_objects_in_the_image_are_named_from_left_to_right():
    text = told()
    assert "The scene has right; left; behind; above." in text
    assert "In its image, from left to right: left; right." in text
    hidden = objects.hide(SCENE, [next(iter(SCENE.origin.places))])
    assert "The scene has left; behind; above." in told(scene=hidden)
    assert "In its image" not in told(scene=hidden)
    assert "The scene is empty." in told(scene=scene_of({}))
    for more in (0, 2):
        names = [str(k) for k in range(MOST_NAMED + more)]
        shown = "; ".join(names[:MOST_NAMED]) + ("; and 2 more." if more else ".")
        assert f"The scene has {shown}" in told(scene=scene_of(dict.fromkeys(names, (0, 0, 0))))


def test_the_camera_is_told_with_its_numbers():
    text = told()
    assert "perspective, eye (0, 0, 5), looking along (0, 0, -1)" in text
    assert "from u = -0.5 to 0.5 and from v = -0.5 to 0.5, at distance d = 1." in text
    assert "at distance" not in told(camera=replace(CAMERA, projection="parallel"))
    assert "Lens: " not in text and "Lens: " in told(
        camera=replace(CAMERA, lens=Lens("fov", {"omega": 1}))
    )


@pytest.mark.parametrize(
    ("pixel", "camera", "said"),
    [
        ((2, 1), CAMERA, "Pixel (3, 2) is marked: its ray has p = (0, 0, 5) and "
         "d = (-0.2, 0, -1), and first hits left at t = "),
        ((0, 2), CAMERA, "and hits nothing; the colour is ("),
        ((0, 0), replace(CAMERA, viewport=(-9, 9, -9, 9), lens=Lens("equidistant")),
         "Pixel (1, 1) is marked; the lens sees nothing there."),
        ((5, 0), CAMERA, None), ((0, 5), CAMERA, None), (None, CAMERA, None),
    ],
)  # fmt: skip
def test_the_marked_pixel_is_told_with_its_ray(pixel, camera, said):
    text = told(camera=camera, marked=pixel)
    assert said in text if said else "is marked" not in text


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({}, "the basis u, v, w, the image plane, the view volume. "),
        ({"volume": False, "basis_grown": 0.0}, "with the image plane. "),
        ({"volume": False, "image": False, "basis": False}, "with its eye. "),
        ({"volume": False, "half_line": 1.0}, "the image plane, p. "),
        ({"volume": False, "half_line": 2.0}, "the image plane, p, d. "),
        ({"volume": False, "half_line": 2.5, "meetings": 0.5},
         "p, d, t = 1, 2, 3, all t at which it meets objects. "),
        ({"bundle": (2, 3)}, "the view volume, 2 x 3 viewing rays. "),
        ({"bundle": (2, 0)}, "the view volume. "),
        ({"points": ((0, 0, 0),)}, "the view volume, the rays of 1 points. "),
        ({"points": ((0, 0, 0),), "points_grown": 0.0}, "the view volume. "),
        ({"target": (1, 2, 3)}, "the view volume, the target (1, 2, 3). "),
        ({"formula": 2.5}, "2.5 of "),
        ({"pixels": True}, "the plane's 5 x 5 pixels, with f = 5 and c = (2, 2). "),
    ],
)  # fmt: skip
def test_the_outside_view_s_parts_are_told(options, said):
    assert said in told("outside", outside=options)


def test_a_ray_is_told_outside_once_it_is_marked_and_drawn():
    ray = "the marked pixel's ray"
    assert ray in told("outside", marked=(1, 1)) and ray not in told("outside")
    assert ray not in told("outside", marked=(1, 1), outside={"ray": False})


def test_pixels_are_not_told_of_parallel_rays():
    parallel = replace(CAMERA, projection="parallel")
    text = told("outside", camera=parallel, outside={"pixels": True})
    assert "with the basis u, v, w, the image plane, the view volume. " in text


def test_letters_of_formulas_are_those_that_all_fonts_have():
    for style, kind in (("mathbf", "bold"), ("mathsf", "sans")):
        for letter in "AZaz":
            found = inline(rf"\{style}{{{letter}}}")
            assert f"{kind}" in found and f">{letter}<" in found, found


def test_a_figure_s_paper_reaches_as_far_behind_the_plane_as_the_vectors_are_long():
    one, other = paper(CAMERA), paper(replace(CAMERA, distance=3.0, w=(0, 0, 2)))
    assert other["reach"] == pytest.approx(6 * one["reach"])
    assert np.allclose(other["corners"], np.array(one["corners"]) - (0, 0, 5))


def test_a_part_s_name_is_above_the_steps_that_have_one(lecture):
    gray = np.full((3, 4, 3), 128, np.uint8)
    for part in ("", "Rays"):
        step = replace(lecture.builds[0], part=part)
        html = page(replace(lecture, builds=(step,)), [[Still(step.views[0], gray)]])
        assert ('<p class="part">Rays</p>' in html) == bool(part)
        assert '<p class="part"></p>' not in html
        assert 'width="4" height="3" alt="' in html
