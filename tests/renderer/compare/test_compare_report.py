"""The report and the pictures of a comparison: on images with known flaws."""

from dataclasses import replace

import numpy as np
import pytest
from flawed_images import CAMERA, SIZE, changed, image, wall

from lucida.renderer.compare.raster_and_ray import CAUSES, LABEL_COLORS, compare_frames
from lucida.renderer.images import encode_srgb
from lucida.renderer.images.difference import CAUSE_COLORS, difference, false_color
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Scene


def test_what_is_told_of_a_comparison():
    """The command's lines and the status line, with and without causes."""
    at = CAMERA.image_point(0, 20, SIZE)[0] * 2
    flat = flatten(Scene((wall(-2, right=float(at)), wall(-3))))
    exact = changed(image(2, 0, 0), np.s_[:, 20:], depth=3, id=1, primitive=2)
    exact = replace(exact, time_s=0.0025)
    snapped = changed(exact, np.s_[:, 20], depth=2, id=0, primitive=0)
    comparison = compare_frames(flat, CAMERA, SIZE, snapped, exact)
    assert comparison.verdict() == "all but 24 edge pixels agree"
    lines = comparison.summary().split("\n")
    assert lines[:3] == [
        "32x24: 744 of 768 pixels agree",
        "explained:   24 (edge 24)",
        "unexplained: 0",
    ]
    assert lines[-1] == "raster 2.5 ms, ray 2.5 ms"
    one = changed(exact, (3, 20), depth=2, id=0, primitive=0)  # a single pixel has its cause too
    comparison = compare_frames(flat, CAMERA, SIZE, one, exact)
    assert comparison.verdict() == "all but 1 edge pixel agree"
    both = replace(comparison, explained=dict.fromkeys(CAUSES, 0) | {"edge": 1, "clip": 2})
    assert both.verdict() == "all but 3 pixels agree (edge, clip)"
    comparison = compare_frames(flat, CAMERA, SIZE, changed(exact, (3, 4), color=0.9), exact)
    lines = comparison.summary().split("\n")
    assert lines[1:3] == ["explained:   0", "unexplained: 1 (1 in the colour alone)"]
    wrong = compare_frames(flat, CAMERA, SIZE, changed(exact, (3, 4), id=9), exact)
    assert wrong.summary().split("\n")[2] == "unexplained: 1"


def test_the_difference_image_is_the_raster_image_darkened():
    flat = flatten(Scene((wall(-2),)))
    ramp = np.linspace(0, 1, 32, dtype=np.float32)
    frame = changed(image(2, 0, 0), 0, color=ramp[:, None])
    comparison = compare_frames(flat, CAMERA, SIZE, changed(frame, (3, 4), id=7), frame)
    picture = comparison.difference_image()
    wanted = [int(0.35 * 255 * value) for value in encode_srgb(ramp)]
    assert picture.dtype == np.uint8 and tuple(picture[3, 4]) == (255, 94, 0)
    assert picture[0].tolist() == [[value] * 3 for value in wanted]
    found = difference(frame, frame, "depth")
    assert (comparison.false_color("depth", 4.0) == false_color(found, "depth", 4.0)).all()
    assert LABEL_COLORS.shape == (256, 3)
    for label, name in enumerate(CAUSES, start=1):
        assert tuple(LABEL_COLORS[label]) == CAUSE_COLORS[name]


def test_errors_of_images_that_have_nothing_in_common():
    """Hit by one alone: no error where they agree."""
    flat = flatten(Scene((wall(-2),)))
    missed = image(np.inf, -1, -1)
    comparison = compare_frames(flat, CAMERA, SIZE, missed, image(2, 0, 0))
    assert comparison.max_depth_error == comparison.max_normal_error == 0
    frame = image(2, 0, 0)
    some = changed(changed(frame, (5, 6), color=np.nan), (2, 3), color=1.0)
    found = compare_frames(flat, CAMERA, SIZE, some, changed(frame, (2, 3), color=0.0))
    assert found.largest_color == pytest.approx(1) and found.worst == (5, 6)
    assert found.rms_color == pytest.approx(1 / np.sqrt(767))


def test_the_smallest_differences_are_told_as_they_are():
    """After the display transform, which makes those of dark colours 12.92 times as large."""
    flat = flatten(Scene((wall(-2),)))
    for color, by in ((0.5, 2e-6), (0.0, 5e-6)):
        frame = changed(image(2, 0, 0), (3, 4), color=color)
        near = changed(frame, (3, 4), color=color + by)
        comparison = compare_frames(flat, CAMERA, SIZE, frame, near)
        exact = float(encode_srgb(np.float32(color + by)) - encode_srgb(np.float32(color)))
        assert comparison.max_color_error == pytest.approx(exact, rel=1e-2)
        assert comparison.worst == (3, 4)
    missed = compare_frames(flat, CAMERA, SIZE, image(np.inf, -1, -1), frame)
    assert missed.max_color_error == 0
