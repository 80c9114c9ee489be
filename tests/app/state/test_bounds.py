"""Bounds of options: on every field, and the same for keys, fields, sessions and lectures."""

import json
import math
from dataclasses import fields, is_dataclass, replace
from typing import Annotated, get_args, get_origin, get_type_hints

import pytest
from option_changes import with_options

from lucida.app.images.placement import STEPS
from lucida.app.lecture.step_options import options_from_table
from lucida.app.state.app_state import AppState
from lucida.app.state.bounds import (
    AtMost,
    check,
    range_of,
    whole_range_of,
)
from lucida.app.state.options import Options
from lucida.app.state.options.compare import CompareOptions
from lucida.app.state.options.laboratory import LaboratoryOptions
from lucida.app.state.options.outside import OutsideOptions
from lucida.app.state.options.shared import Bookmark, ImageOptions, Preferences
from lucida.app.state.options.stepper import StepperOptions
from lucida.app.state.session import Arrangement, from_bytes, session_of, to_bytes
from lucida.app.window.actions import FONT_SCALES
from lucida.app.window.bookmarks import NUMBERS
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.scene import View
from lucida.renderer.system.errors import LucidaError

# part, field, value, where the error is, what it says
WRONG = [
    ("images", "exposure_ev", 8.5, "", "8.5 is out of range; give -8 to 8"),
    ("images", "samples", 3, "", "3 is not possible; give one of 1, 4, 16, 64"),
    ("images", "resolution", [0, 5], "", "0x5 has no pixels"),
    ("images", "resolution", [16384, 16384], "", "16384x16384 is too large"),
    ("images", "magnification", 0.0, "", "0 is out of range; give 0.015625 to 128"),
    ("images", "center", [0.5, 1.5], "[1]", "1.5 is out of range; give 0 to 1"),
    ("compare", "gain", -1.0, "", "-1 is out of range; give 1 to 1024"),
    ("outside", "bundle", [65, 1], "[0]", "65 is out of range; give 0 to 64"),
    ("probe", "pins", [[0, 1], [2, -1]], "[1][1]", "-1 is out of range; give 0 to 16383"),
    ("probe", "pins", [[0, 0]] * 257, "", "has 257 entries; give at most 256"),
    ("stepper", "canvas", [100_000, 100_000], "[0]", "100000 is out of range; give 1 to 64"),
]


@pytest.fixture(scope="module")
def state():
    return AppState.for_scene(load_scene("spheres"))


def _numbers(hint, bounded, path):
    """(path, whether it is bounded) of each number that a type can hold."""
    if get_origin(hint) is Annotated:
        bounded = bounded or not all(isinstance(mark, AtMost) for mark in hint.__metadata__)
        hint = get_args(hint)[0]
    if hint in (int, float):
        yield path, bounded
    elif is_dataclass(hint) and hint not in (Camera, View):  # which check themselves
        hints = get_type_hints(hint, include_extras=True)
        for field in fields(hint):
            yield from _numbers(hints[field.name], False, f"{path}.{field.name}")
    else:
        for part in get_args(hint):
            yield from _numbers(part, bounded, path)


def test_every_number_among_the_options_has_a_bound():
    found = dict(_numbers(Options, False, "options"))
    assert len(found) > 15
    assert [path for path, bounded in found.items() if not bounded] == []


@pytest.mark.parametrize(("part", "field", "value", "entry", "told"), WRONG)
def test_sessions_and_lectures_refuse_the_same(state, part, field, value, entry, told):
    with pytest.raises(LucidaError) as caught:
        options_from_table({part: {field: value}})
    assert caught.value.field == f"{part}.{field}{entry}"
    assert told in str(caught.value)
    table = json.loads(to_bytes(session_of(state, Arrangement())))
    table["options"][part][field] = value
    with pytest.raises(LucidaError) as caught:
        from_bytes(json.dumps(table).encode(), "session-1.json")
    assert caught.value.field == f"options.{part}.{field}{entry}"
    assert told.split(";")[0] in str(caught.value)
    assert caught.value.remedy == "Lucida starts afresh"


@pytest.mark.parametrize(("part", "field", "value", "entry", "told"), WRONG)
def test_what_a_key_or_a_field_asks_for_comes_within_bounds(state, part, field, value, entry, told):
    """So that no session is written that is refused when the window opens again."""
    if isinstance(value, list):
        value = tuple(tuple(v) if isinstance(v, list) else v for v in value)
    changed = with_options(state, **{part: {field: value}})
    check(Options, changed.options)
    read = from_bytes(to_bytes(session_of(changed, Arrangement())))
    assert read.options == changed.options


def test_clamping_takes_the_nearest_and_leaves_the_rest(state):
    changed = with_options(
        state,
        images={"exposure_ev": 100.0, "samples": 14, "center": (-3.0, 0.25), "grid": False},
        compare={"gain": math.nan},
        laboratory={"progress": 9.0, "phase": math.nan},
        stepper={"canvas": (16, 49)},
        marked=(-1, 3),
        probe={"pins": tuple((k, k) for k in range(300))},
    )
    assert changed.images == replace(
        ImageOptions(), exposure_ev=8.0, samples=16, center=(0.0, 0.25), grid=False
    )
    assert changed.options.compare == CompareOptions(gain=1.0)
    assert changed.options.laboratory == LaboratoryOptions(progress=4.0)
    assert changed.options.stepper == StepperOptions(canvas=(16, 48))
    assert changed.marked == (0, 3)
    assert changed.options.probe.pins == tuple((k, k) for k in range(44, 300))


def test_sliders_take_their_limits_from_the_fields():
    assert range_of(CompareOptions, "gain") == (1.0, 1024.0)
    assert range_of(ImageOptions, "magnification") == (1 / 64, 128.0)  # of `float | None`
    assert whole_range_of(OutsideOptions, "bundle") == (0, 64)  # of a list's entries
    assert all(isinstance(limit, int) for limit in whole_range_of(OutsideOptions, "bundle"))


def test_what_steps_through_a_range_ends_at_its_bounds():
    assert (STEPS[0], STEPS[-1]) == range_of(ImageOptions, "magnification")
    assert (FONT_SCALES[0], FONT_SCALES[-1]) == range_of(Preferences, "font_scale")
    assert (NUMBERS[0], NUMBERS[-1]) == whole_range_of(Bookmark, "number")


def test_a_camera_among_a_lectures_options_is_a_table():
    table = {"outside": {"camera": {"eye": [0, 0, 9]}, "grid": False}}
    assert options_from_table(table)["outside"] == {"camera": Camera((0, 0, 9)), "grid": False}
    for options, told in (
        ({"camera": 3}, "outside.camera: is not a table; give e.g. camera.eye"),
        ({"camera": {"eye": [0, 0]}}, "outside.camera.eye: has 2 entries; give 3"),
        ({"grid": {"eye": [0, 0, 9]}}, "outside.grid: is a table; give true or false"),
    ):
        with pytest.raises(LucidaError) as error:
            options_from_table({"outside": options})
        assert str(error.value) == told
