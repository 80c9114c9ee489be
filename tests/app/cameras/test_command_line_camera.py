"""Camera options on the command line: the window takes them, and mistakes are one line."""

from __future__ import annotations

from dataclasses import replace

import pytest
from copied_views import NOW

from lucida.app.cli import main
from lucida.renderer.scene.model import View
from tests.support.refusals import refused


@pytest.fixture
def opened(monkeypatch) -> list[View | None]:
    """Collect the views that windows open with; None if no option changes the scene's."""
    views: list[View | None] = []
    monkeypatch.setattr(
        "lucida.app.window.launch.run_viewer",
        lambda *_, change, **__: views.append(change and change(NOW)) or 0,
    )
    return views


def test_the_window_opens_with_the_given_camera(opened) -> None:
    assert main(["spheres", "--eye=0.5,1.5,-6.25", "--near=1.5"]) == 0
    assert main(["spheres"]) == 0
    camera = replace(NOW.camera, eye=(0.5, 1.5, -6.25), near=1.5)
    assert opened == [replace(NOW, camera=camera), None]


@pytest.mark.parametrize(
    ("options", "fit"),
    [
        (["--viewport=-1,1,-1,1"], False),
        (["--viewport=-1,1,-1,1", "--fit"], True),
        (["--no-fit"], False),
        (["--eye=1,2,3"], True),
    ],
)
def test_a_viewport_is_fitted_only_with_fit(opened, options, fit: bool) -> None:
    assert main(options) == 0
    assert opened.pop().fit is fit


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("--eye=1,2", "'1,2' is not 3 numbers; give e.g. 0,0,5"),
        ("--viewport=1,2,3", "is not 4 numbers; give e.g. -0.5,0.5"),
        ("--near=a", "'a' is not a number"),
        ("--w=0,0,0", "--w: (0, 0, 0) is not independent of u and v; give w a part"),
        ("--distance=nan", "--distance: nan is not finite"),
    ],
)
def test_a_mistake_is_one_line(tmp_path, monkeypatch, capsys, options: str, message: str) -> None:
    monkeypatch.chdir(tmp_path)
    assert message in refused(capsys, "render", "spheres", "-o", "a.png", options)
