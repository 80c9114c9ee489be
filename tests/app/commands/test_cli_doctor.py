"""`lucida doctor`: the report's two forms and its exit status; the checks are stand-ins."""

from __future__ import annotations

import pytest

import lucida.renderer.system.doctor
from lucida import __version__
from lucida.app.cli import main
from lucida.renderer.system.doctor import Check

EGL = Check("egl", "draws without a window", True, "llvmpipe, OpenGL 4.5", "")
NO_EGL = Check("egl", "draws without a window", False, "libEGL is missing", "install libegl1")
NO_DISPLAY = Check("display", "shows the window", False, "DISPLAY is not set", "log in")


@pytest.fixture
def checks(monkeypatch):
    found = [EGL, NO_DISPLAY]
    monkeypatch.setattr(lucida.renderer.system.doctor, "report", lambda: found)
    monkeypatch.setattr(lucida.renderer.system.doctor, "candidates", lambda: ("egl", "osmesa"))
    return found


def test_text_says_what_works_and_what_to_do(checks, capsys):
    assert main(["doctor"]) == 0
    first, _, *lines = capsys.readouterr().out.splitlines()
    assert first.startswith(f"lucida {__version__}, Python 3.")
    assert lines == [
        "egl       works  draws without a window: llvmpipe, OpenGL 4.5",
        "display   no     shows the window: DISPLAY is not set",
        "                 log in",
    ]


def test_no_platform_is_status_1(checks, capsys):
    checks[0] = NO_EGL
    assert main(["doctor"]) == 1
    told = capsys.readouterr().out
    assert "install libegl1" in told
    assert told.endswith("No OpenGL platform works: only the ray tracer can draw.\n")
