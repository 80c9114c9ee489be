"""Text and picture of the built-in lecture agree: what a step names is drawn, and large enough."""

import numpy as np
import pytest
from both_lectures import both_lectures
from plain_text import plain_text

from lucida.app.instruments.outside.camera_diagram import Content, diagram
from lucida.app.instruments.outside.diagram import Dot, Eye, Label, RayEnd
from lucida.app.state.options.outside import OutsideOptions

VIEW = (818, 634)  # the outside view's pixels beside the text, in a window of 1280 x 720


def steps():
    """Return all steps by title, at their last builds."""
    return {build.title: build for build in both_lectures().builds}


def text_of(title):
    return str(plain_text(steps()[title].blocks))


def options_of(title):
    given = dict(steps()[title].changes.get("outside", {}))
    return OutsideOptions(**given)


def items_of(title):
    step = steps()[title]
    size = step.changes.get("images", {}).get("resolution", VIEW)
    return diagram(Content(step.view.for_size(size), size, options_of(title), 9.0))


def labels_of(title):
    return {item.text for item in items_of(title) if isinstance(item, Label)}


def test_where_there_is_no_eye_none_is_drawn():
    assert "parallel" in text_of("Parallel projection")
    for title, step in steps().items():
        if "outside" in step.views:
            parallel = step.view.camera.is_parallel
            kinds = {type(item) for item in items_of(title)}
            assert (Eye in kinds) != parallel, title
            assert parallel or {"vec(e)", "(0, 0, 0)"} & labels_of(title), title
    assert "vec(e)" not in labels_of("Parallel projection")
    assert "vec(e)" in labels_of("Parallel: the pixel moves the origin")  # its formula has it


@pytest.mark.parametrize("title", ["The basis from a target", "Exercise: find the basis"])
def test_target_and_up_are_drawn_where_they_are_named(title):
    step = steps()[title]
    assert {"target", "up"} <= labels_of(title)
    camera, (dot,) = (
        step.view.camera,
        [item for item in items_of(title) if isinstance(item, Dot) and item.name == "target"],
    )
    back = np.asarray(camera.eye) - dot.point  # w is from target to eye, here as well
    assert np.allclose(np.cross(back, camera.w), 0) and back @ np.asarray(camera.w) > 0


def test_the_points_of_the_ray_are_drawn_where_their_parameters_are_named():
    title = "A ray is half a line"
    step = steps()[title]
    assert step.pixel is not None
    size = step.changes["images"]["resolution"]
    marked = RayEnd(step.pixel, 2.5)
    camera = step.view.for_size(size)
    items = diagram(Content(camera, size, options_of(title), 9.0, marked=marked))
    at = {item.name: item.point for item in items if isinstance(item, Dot)}
    ray = camera.ray(*step.pixel, size)
    assert np.allclose(at["p"], ray.origin)
    assert np.allclose(at["t = 1"], ray.origin + ray.direction)
