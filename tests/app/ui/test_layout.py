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
    whole numbers."""

    def __init__(self, size: float, rest: float, room: float) -> None:
        self.parent = SimpleNamespace(id_=3, parent_node=None, split_axis=imgui.internal.Axis.x)
        self.nodes = {
            k: SimpleNamespace(id_=k, parent_node=self.parent, is_empty=bool) for k in (1, 2)
        }
        for number, width in enumerate((size, rest), 1):
            self.set_size(number, (width, 1.0))
        self.resize(room)

    def set_size(self, number: int, size: tuple[float, float]) -> None:
        self.nodes[number].size = self.nodes[number].size_ref = ImVec2(size[0], 500.0)

    def resize(self, room: float) -> None:
        self.parent.size = ImVec2(room, 500.0)

    @property
    def widths(self) -> tuple[float, float]:
        return self.nodes[1].size.x, self.nodes[2].size.x


def start(monkeypatch, dock: Dock, kept: Proportion, rooms: tuple[float, ...]) -> None:
    nodes = {SPACE: dock.nodes[1], layout.MAIN: dock.nodes[2]}
    monkeypatch.setattr(imgui, "is_mouse_down", lambda _: True)
    monkeypatch.setattr(imgui, "get_style", lambda: SimpleNamespace(docking_separator_size=0.0))
    monkeypatch.setattr(layout, "node_of", nodes.get)
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
    dock = Dock(460.0, 818.0, 1278.0)
    for _ in range(5):
        start(monkeypatch, dock, Proportion(), (first, 1278.0))
        assert dock.widths == (460.0, 818.0)
        dock = Dock(*map(int, dock.widths), first)


def test_what_is_saved_is_whole(monkeypatch) -> None:
    dock = Dock(460.0, 818.0, 1278.0)
    start(monkeypatch, dock, Proportion(), (1278.0, 1001.0))
    assert dock.widths == (360.0, 641.0)


def test_the_users_division_is_kept(monkeypatch) -> None:
    dock, kept = Dock(460.0, 540.0, 1000.0), Proportion()
    start(monkeypatch, dock, kept, (1000.0,))
    dock.set_size(1, (300.0, 1.0))  # dragged
    start(monkeypatch, dock, kept, (1000.0, 500.0))
    assert dock.widths == (150.0, 350.0)
