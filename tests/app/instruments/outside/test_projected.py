"""Symbols of the outside view on the screen: discs, arrows' heads, the eye, labels' least size."""

from __future__ import annotations

import numpy as np
import pytest

from lucida.app.instruments.outside.diagram import Arrow, Dot, Eye, Label, Segments
from lucida.app.instruments.outside.projected import Shape, Strokes, Text, project
from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.renderer.camera.camera import Camera

SIZE = (400, 300)
SYMBOL_PX = 2.5
AHEAD = Camera.look_at((0, 0, 10), (0, 0, 0), fov_y_deg=40.0, aspect=4 / 3)
OF_SCREEN = {
    "ahead": AHEAD,
    "askew": Camera(AHEAD.eye, AHEAD.u, (0.3, 1.2, 0.0), AHEAD.w, AHEAD.distance, AHEAD.viewport),
}
MIDDLE = np.array([200.0, 150.0])


def filled(parts):
    """Return the shapes, each of which is followed by its edge."""
    shapes, edges = parts[::2], parts[1::2]
    for shape, edge in zip(shapes, edges, strict=True):
        assert isinstance(shape, Shape) and isinstance(edge, Strokes)
        assert (shape.name, shape.layer, shape.tint) == (edge.name, edge.layer, edge.tint)
        np.testing.assert_array_equal(shape.points, edge.points[:, 0])
    return shapes


@pytest.fixture(params=OF_SCREEN)
def screen(request):
    return OutsideScreen(OF_SCREEN[request.param], SIZE, 1e-3, 2.0, SYMBOL_PX)


def test_a_dot_is_a_disc_of_its_diameter_in_symbols(screen) -> None:
    [disc] = project([Dot("e", "eye", np.zeros(3), 6.0)], screen)
    assert isinstance(disc, Strokes)
    assert disc.width_px == 2 * 6.0 * SYMBOL_PX
    np.testing.assert_allclose(disc.points, [[MIDDLE, MIDDLE]], atol=1e-9)


def test_a_line_is_as_wide_as_its_units_and_an_arrow_without_length_is_none(screen) -> None:
    ends = np.array([[[0.0, 0, 0], [1, 0, 0]]])
    [line] = project([Segments("l", "extra", ends, 3.0)], screen)
    assert isinstance(line, Strokes) and line.width_px == 3.0 * 2.0
    assert project([Arrow("w", "w", np.zeros(3), np.zeros(3))], screen) == []


def test_a_head_is_wider_than_its_shaft_however_thick_that_is(screen) -> None:
    for width in (3.2, 8.0):
        shaft, head, *_ = project([Arrow("u", "u", np.zeros(3), 5 * np.eye(3)[0], width)], screen)
        assert isinstance(shaft, Strokes) and isinstance(head, Shape)
        assert np.ptp(head.points[:, 1]) > 2 * shaft.width_px


def test_a_head_has_a_dark_base_under_its_shaft_only_from_behind(screen) -> None:
    for end, names in (((0.3, 0.2, -2.0), ["head", "base"]), ((0.3, 0.2, 2.0), ["head"])):
        parts = project([Arrow("w", "w", np.zeros(3), np.array(end))], screen)
        shaft, cone = parts[0], filled(parts[1:])
        assert isinstance(shaft, Strokes)
        assert [part.name for part in cone] == [f"w {name}" for name in names]
        for part in cone:
            assert (part.layer > shaft.layer) == (end[2] > 0)
            assert (part.tint < 0) == part.name.endswith("base")


def test_an_eye_that_looks_to_the_viewer_has_an_iris_and_a_darker_pupil_in_it(screen) -> None:
    gaze = np.array([0.1, 0.15, 1.0])
    ball, *parts = project([Eye("e", np.zeros(3), gaze, 12.0)], screen)
    iris, pupil = filled(parts)
    assert isinstance(ball, Strokes)
    assert ball.layer < iris.layer < pupil.layer
    assert 0 > iris.tint > pupil.tint >= -1
    radius = ball.width_px / 2
    for part, angle_deg in ((iris, 40.0), (pupil, 20.0)):
        away = np.linalg.norm(part.points - MIDDLE, axis=1)
        assert away.max() < radius
        across = np.ptp(part.points[:, 0])  # almost a circle, seen almost from the front
        assert across == pytest.approx(2 * radius * np.sin(np.radians(angle_deg)), rel=0.06)
        assert part.points.mean(axis=0)[1] < MIDDLE[1] - 0.05 * radius  # it looks up
    [ball] = project([Eye("e", np.zeros(3), -gaze, 12.0)], screen)
    assert isinstance(ball, Strokes)


def test_a_label_is_left_out_where_its_line_has_less_than_its_least_length(screen) -> None:
    away = np.array([1.0, 0.0, 0.0])
    length_px = np.linalg.norm(screen.seen(away).points - MIDDLE)
    for least, is_shown in ((0.99, True), (1.01, False)):
        label = Label("l", "extra", "1", np.zeros(3), away, least=least * length_px / SYMBOL_PX)
        parts = project([label], screen)
        assert [type(part) for part in parts] == [Text] * is_shown
