"""The effect of handles on a scene, and their texts."""

from __future__ import annotations

import numpy as np
import pytest
from imgui_bundle import ImVec2

from lucida.app.instruments.objects.handles import (
    cleaned,
    frame_of,
    gizmo,
    handle_of,
    length_px,
    moved_by,
    operation_of,
)
from lucida.app.ui import theme
from lucida.renderer.editing import objects
from lucida.renderer.editing.changing import fields_of, set_field
from lucida.renderer.editing.moving import bounds_of, matrix_of
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError

CENTER = (1.0, 2.0, 3.0)


@pytest.fixture
def items() -> tuple[Scene, dict[str, int]]:
    scene, found = Scene(objects=()), {}
    for kind in ("box", "sphere", "point", "directional", "torus"):
        table = objects.new_table(scene, kind, at=(0.5, 1.0, -0.5), size=1.0)
        scene, (found[kind],) = objects.add(scene, table)
    return scene, found


def moved(by: tuple[float, float, float]) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = by
    return matrix


def turned(degrees: float) -> np.ndarray:
    matrix, angle = np.eye(4), np.radians(degrees)
    matrix[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    return matrix


def test_one_thing_s_handles_stand_in_its_own_space(items):
    scene, found = items
    for kind in ("box", "sphere", "point"):
        assert np.array_equal(
            frame_of(scene, (found[kind],), CENTER), matrix_of(scene, found[kind])
        )


def test_several_have_them_in_their_middle_along_the_world(items):
    scene, found = items
    both = found["box"], found["torus"]
    frame = frame_of(scene, both, CENTER)
    assert np.array_equal(frame[:3, :3], np.eye(3))
    assert np.allclose(frame[:3, 3], bounds_of(scene, both).mean(axis=0))
    lights = frame_of(scene, (found["directional"],) * 2, CENTER)
    assert tuple(lights[:3, 3]) == CENTER


def test_what_can_be_done_to_what(items):
    scene, found = items
    operations = gizmo.OPERATION

    def offered(handle, *kinds):
        return operation_of(scene, tuple(found[kind] for kind in kinds), handle)

    assert offered("move") is None
    assert offered("none", "box") is None
    assert offered("move", "box") == offered("move", "point") == operations.translate
    assert offered("move", "directional") is None
    assert offered("move", "directional", "box") == operations.translate
    assert offered("turn", "box") == offered("turn", "directional") == operations.rotate
    assert offered("turn", "sphere") is None
    assert offered("turn", "point") is None
    assert offered("turn", "point", "sphere") == operations.rotate  # about their middle
    assert offered("scale", "box") == operations.scale
    assert offered("scale", "sphere") == offered("scale", "box", "torus") == operations.scaleu
    assert offered("scale", "point") is None
    assert offered("scale", "point", "directional") is None


def test_one_thing_goes_where_its_handle_goes(items):
    scene, found = items
    frame = frame_of(scene, (found["box"],), CENTER)
    now = moved((1, 2, 3)) @ frame @ turned(30) @ np.diag([1, 2, 3, 1])
    after = moved_by(scene, (found["box"],), frame, now)
    assert np.allclose(matrix_of(after, found["box"]), now, atol=1e-9)
    assert np.array_equal(matrix_of(after, found["torus"]), matrix_of(scene, found["torus"]))


def test_several_go_by_what_the_handle_did(items):
    scene, found = items
    both = found["box"], found["point"]
    frame = frame_of(scene, both, CENTER)
    after = moved_by(scene, both, frame, moved((0.5, 0, -1)) @ frame)
    by = matrix_of(after, found["box"])[:3, 3] - matrix_of(scene, found["box"])[:3, 3]
    assert np.allclose(by, (0.5, 0, -1))
    place = np.subtract(
        fields_of(after, found["point"]).position, fields_of(scene, found["point"]).position
    )
    assert np.allclose(place, (0.5, 0, -1))


def test_what_no_file_can_say_is_told(items):
    scene, found = items
    frame = frame_of(scene, (found["sphere"],), CENTER)
    with pytest.raises(LucidaError, match="ellipsoid"):
        moved_by(scene, (found["sphere"],), frame, frame @ np.diag([1, 2, 3, 1]))


def test_a_handle_s_noise_does_not_reach_the_file(items):
    """ImGuizmo's numbers have single precision."""
    scene, found = items
    scene = set_field(scene, [found["box"]], "translate", [1.35, 1.17, -1.6])
    scene = set_field(scene, [found["box"]], "rotate_deg", [0, 28, 0])
    frame = frame_of(scene, (found["box"],), CENTER)
    single = frame.astype(np.float32).astype(float)
    raised, tilted, grown = single.copy(), single.copy(), single.copy()
    raised[1, 3] = np.float32(2.25)
    tilted[:3, :3] = (about_y(15.0) @ single[:3, :3]).astype(np.float32)
    grown[:3, :3] = (single[:3, :3] * 1.5).astype(np.float32)

    def after(handle, result):
        new = moved_by(scene, (found["box"],), frame, cleaned(handle, frame, result))
        return fields_of(new, found["box"])

    was = fields_of(scene, found["box"])
    moved_box = after("move", raised)
    assert list(moved_box.translate) == [1.35, 2.25, -1.6]
    assert (moved_box.rotate_deg, moved_box.scale) == (was.rotate_deg, was.scale)
    turned_box = after("turn", tilted)
    assert np.allclose(turned_box.rotate_deg, (0, 43, 0), rtol=0, atol=1e-9)
    assert np.allclose(turned_box.scale, 1, rtol=0, atol=1e-9)
    assert list(turned_box.translate) == [1.35, 1.17, -1.6]
    grown_box = after("scale", grown)
    assert np.allclose(grown_box.scale, 1.5, rtol=0, atol=1e-9)
    assert np.allclose(grown_box.rotate_deg, (0, 28, 0), rtol=0, atol=1e-9)


def about_y(degrees: float) -> np.ndarray:
    angle = np.radians(degrees)
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def test_what_has_a_direction_alone_is_turned_where_others_are_moved(items):
    scene, found = items

    def kind(wanted, *kinds):
        return handle_of(scene, tuple(found[name] for name in kinds), wanted)

    assert kind("move", "directional") == "turn"
    assert kind("move", "directional", "box") == "move"
    assert kind("move", "point") == "move"
    assert kind("none", "directional") == "none"
    assert kind("scale", "directional") == "scale"


@pytest.mark.parametrize("size", [(100, 768), (768, 100)])
def test_handles_stay_in_a_narrow_picture(size, monkeypatch) -> None:
    monkeypatch.setattr(theme, "px", float)  # type of 100 %, which ImGui knows in a window alone
    assert length_px(ImVec2(*size), ImVec2(*size)) == pytest.approx(24)
