"""The effect of the moving handle on a scene, and its size."""

from __future__ import annotations

import numpy as np
import pytest
from imgui_bundle import ImVec2

from lucida.app.instruments.objects.handles import length_px, middle_of, way_of
from lucida.app.ui import theme
from lucida.renderer.editing import objects
from lucida.renderer.editing.changing import fields_of, set_field
from lucida.renderer.editing.moving import bounds_of, shift
from lucida.renderer.scene.model import Scene


@pytest.fixture
def items() -> tuple[Scene, dict[str, int]]:
    scene, found = Scene(objects=()), {}
    for kind in ("box", "sphere", "point", "directional", "torus"):
        table = objects.new_table(scene, kind, at=(0.5, 1.0, -0.5), size=1.0)
        scene, (found[kind],) = objects.add(scene, table)
    return scene, found


def test_handles_are_in_the_middle_of_what_has_a_place(items):
    scene, found = items
    assert tuple(middle_of(scene, (found["point"],))) == (0.5, 1.0, -0.5)
    both = found["box"], found["torus"]
    assert np.allclose(middle_of(scene, both), bounds_of(scene, both).mean(axis=0))
    assert middle_of(scene, (found["directional"],)) is None
    assert middle_of(scene, ()) is None


def test_all_selected_go_the_way_of_the_handle(items):
    scene, found = items
    after = shift(scene, (found["box"], found["point"], found["directional"]), (0.5, 0, -1))
    for name, field in (("box", "translate"), ("point", "position")):
        was, now = (getattr(fields_of(one, found[name]), field) for one in (scene, after))
        assert np.allclose(np.subtract(now, was), (0.5, 0, -1))
    for name in ("directional", "torus"):
        assert fields_of(after, found[name]) == fields_of(scene, found[name])


def test_a_handle_s_noise_does_not_reach_the_file(items):
    """ImGuizmo's numbers have single precision."""
    scene, found = items
    scene = set_field(scene, [found["box"]], "translate", [1.35, 1.17, -1.6])
    start = middle_of(scene, (found["box"],))
    end = start.astype(np.float32).astype(float)
    end[1] += np.float32(1.08)
    moved = fields_of(shift(scene, (found["box"],), way_of(start, end)), found["box"])
    assert list(moved.translate) == [1.35, 2.25, -1.6]


@pytest.mark.parametrize("size", [(100, 768), (768, 100)])
def test_handles_stay_in_a_narrow_picture(size, monkeypatch) -> None:
    monkeypatch.setattr(theme, "px", float)  # type of 100 %, which ImGui knows in a window alone
    assert length_px(ImVec2(*size), ImVec2(*size)) == pytest.approx(24)
