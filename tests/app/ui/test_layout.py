"""The places of docked views: each space is the same at the next start as at the last."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from imgui_bundle import ImVec2, imgui

from lucida.app.ui import layout
from lucida.app.ui.layout import LECTURE
from lucida.app.window.proportion import Proportion

SPACE = "RightSpace"
FRAMES = 20  # for a share to take a new room up


class Dock:
    """A space and the one that it was split off from, as ImGui keeps their widths; its file has
    whole numbers, and of the outer one always the present size."""

    def __init__(self, size: float, room: float) -> None:
        self.parent = SimpleNamespace(parent_node=None, split_axis=imgui.internal.Axis.x)
        self.node = SimpleNamespace(id_=1, parent_node=self.parent)
        self.set_size(1, (size, 1.0))
        self.resize(room)

    def set_size(self, _: int, size: tuple[float, float]) -> None:
        self.node.size = self.node.size_ref = ImVec2(size[0], 500.0)

    def resize(self, room: float) -> None:
        self.parent.size = self.parent.size_ref = ImVec2(room, 500.0)

    @property
    def width(self) -> float:
        return self.node.size.x


def start(monkeypatch, dock: Dock, kept: Proportion, rooms: tuple[float, ...]) -> None:
    monkeypatch.setattr(imgui, "is_mouse_down", lambda _: True)
    monkeypatch.setattr(layout, "node_of", lambda space: dock.node if space == SPACE else None)
    monkeypatch.setattr(imgui.internal, "dock_builder_set_node_size", dock.set_size)
    monkeypatch.setattr(layout, "window_px", lambda: (1280.0, 720.0))
    monkeypatch.setattr(layout, "current", lambda: by_name[LECTURE])
    for room in rooms:
        dock.resize(room)
        for _ in range(FRAMES):
            kept.keep()


by_name = {one.name: one for one in layout.LAYOUTS}


@pytest.mark.parametrize("first", [1280.0, 1276.0, 800.0])
def test_a_space_is_as_wide_at_each_start(monkeypatch, first: float) -> None:
    """The window begins in one size; its manager then gives it another."""
    dock, kept = Dock(460.0, 1278.0), Proportion()
    start(monkeypatch, dock, kept, (1278.0,))
    for _ in range(5):
        parts, dock = kept.parts(), Dock(int(dock.width), first)
        kept = Proportion()
        kept.restore(parts)
        start(monkeypatch, dock, kept, (first, 1278.0))
        assert dock.width == 460.0


def test_what_is_saved_is_whole(monkeypatch) -> None:
    dock, kept = Dock(460.0, 1278.0), Proportion()
    start(monkeypatch, dock, kept, (1278.0, 1001.0))
    assert dock.width == 360.0


def test_the_users_division_is_kept_over_the_layouts_and_nonsense_is_left_out(monkeypatch) -> None:
    dock, kept = Dock(460.0, 1000.0), Proportion()
    kept.restore({f"{LECTURE}/{SPACE}": 0.25, f"{LECTURE}/LowerSpace": float("inf"), "x/y": 0.5})
    start(monkeypatch, dock, kept, (1000.0,))
    assert dock.width == 250.0
    dock.set_size(1, (300.0, 1.0))  # dragged
    start(monkeypatch, dock, kept, (1000.0,))
    assert kept.parts() == {f"{LECTURE}/{SPACE}": 0.3}
