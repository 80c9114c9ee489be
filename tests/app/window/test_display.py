"""The facts about a display that are known without opening one."""

from types import SimpleNamespace

import pytest

from lucida.app.window import platform

X11, WAYLAND = {"DISPLAY": ":0"}, {"WAYLAND_DISPLAY": "wayland-0"}


@pytest.mark.parametrize(
    ("system", "variables", "why"),
    [
        ("linux", {}, "DISPLAY is not set"),
        ("linux", WAYLAND, "this Wayland session has no XWayland (DISPLAY is not set)"),
        ("linux", X11, ""),
        ("linux", X11 | WAYLAND, ""),
        ("darwin", {}, ""),
        ("win32", {}, ""),
    ],
)
def test_why_there_is_no_display(monkeypatch, system, variables, why):
    for name in X11 | WAYLAND:
        monkeypatch.delenv(name, raising=False)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(platform.sys, "platform", system)
    assert platform.why_no_display() == why


@pytest.mark.parametrize(
    ("room", "size"),
    [((2560, 1440), (1706, 960)), ((1600, 900), (1280, 720)), ((1024, 600), (1024, 600))],
)
def test_a_window_takes_two_thirds_of_the_screen(monkeypatch, room, size):
    monkeypatch.setattr(platform.glfw, "get_primary_monitor", lambda: 1)
    monkeypatch.setattr(platform.glfw, "get_monitor_workarea", lambda _: (0, 0, *room))
    assert platform.default_size(SimpleNamespace(has_display=True)) == size
