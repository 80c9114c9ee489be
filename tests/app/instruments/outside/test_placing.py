"""Labels of the outside view: they cover nothing, and stay where they are while the view turns."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lucida.app.instruments.outside.placing import Box, LabelPlacer
from lucida.app.instruments.outside.projected import Primitive, Strokes, Text

SIZE = (400.0, 300.0)
BOX = Box(60.0, 16.0, 10.0)


def line(start: tuple[float, float], end: tuple[float, float], width: float = 3.0) -> Strokes:
    points = np.array([[start, end]], float)
    return Strokes("line", "ray", points, np.ones((1, 2)), np.zeros(1), width)


def corners(center: tuple[float, float]) -> np.ndarray:
    half = np.array([BOX.width, BOX.height]) / 2
    return np.array([np.subtract(center, half), np.add(center, half)])


def meet(one: np.ndarray, other: np.ndarray) -> bool:
    return bool((np.maximum(one[0], other[0]) < np.minimum(one[1], other[1])).all())


def text(name: str, at: tuple[float, float], toward: tuple[float, float] = (0.0, 1.0)) -> Text:
    return Text(name, "text", name, at, toward, False)


def test_a_free_label_is_where_its_point_wants_it() -> None:
    ((x, y),) = LabelPlacer().place([text("free", (200, 150), (1.0, 0.0))], (BOX,), SIZE)
    assert (x, y) == (200 + BOX.room + BOX.width / 2, 150)


def test_a_free_label_of_a_line_stands_beside_its_middle_on_the_side_that_it_is_to() -> None:
    way = np.array([(100.0, 150.0), (300.0, 150.0)])
    for side in (-1.0, 1.0):
        label = Text("length", "text", "length", (200, 150), (0.0, side), False, line=way)
        ((x, y),) = LabelPlacer().place([label], (BOX,), SIZE)
        assert x == 200 and (y - 150) * side > BOX.height / 2


def test_labels_of_one_point_a_line_a_mark_and_the_edge_do_not_meet() -> None:
    marks: list[Primitive] = [line((180, 160), (180, 160), 12.0), line((0, 100), (400, 200))]
    texts = [text(name, (180, 146)) for name in "abcd"] + [text("e", (395, 290))]
    found = LabelPlacer().place([*marks, *texts], (BOX,) * 5, SIZE)
    boxes = [corners(center) for center in found]
    for number, box in enumerate(boxes):
        assert (box >= 0).all() and (box <= SIZE).all()
        assert not any(meet(box, other) for other in boxes[:number])
        assert not meet(box, np.array([(174, 154), (186, 166)]))


def test_labels_move_with_what_they_name_and_do_not_jump() -> None:
    placer, before, jumps = LabelPlacer(), None, 0
    for degrees in range(0, 90):
        angle = math.radians(degrees)
        way = (math.cos(angle), math.sin(angle))
        tip = (200 + 80 * way[0], 150 + 80 * way[1])
        parts = [line((200, 150), tip), line((280, 0), (280, 300)), text("v", tip, way)]
        (at,) = placer.place(parts, (BOX,), SIZE)
        if before is not None:
            jumps += math.dist(at, before) > 12
        before = at
    assert jumps <= 3


@pytest.mark.parametrize("side", [(0.0, -1.0), (-1.0, 0.0), (0.0, 1.0), (1.0, 0.0)])
def test_a_label_at_an_edge_is_as_far_inside_as_it_needs_room(side: tuple[float, float]) -> None:
    middle, reach = np.array(SIZE) / 2, np.array(SIZE) / 2 - 1
    at = tuple((middle + reach * side).tolist())
    (found,) = LabelPlacer().place([text("edge", at, side)], (BOX,), SIZE)
    assert (corners(found) >= 0).all() and (corners(found) <= SIZE).all()
    assert math.dist(found, at) < 2 * BOX.room + BOX.width
