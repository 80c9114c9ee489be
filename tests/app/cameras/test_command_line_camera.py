"""Cameras on the command line: the window takes them, a viewport stays, mistakes are one line."""

from __future__ import annotations

from dataclasses import replace

import pytest
from copied_views import NOW

from lucida.app.cli import main
from lucida.app.commands import view as view_command
from tests.support.refusals import refused


class TestCommandLine:
    def test_the_window_takes_it_too(self, monkeypatch) -> None:
        seen = []
        monkeypatch.setattr(
            "lucida.app.window.launch.run_viewer",
            lambda *_, change, **__: seen.append(change and change(NOW)) or 0,
        )
        assert main(["spheres", "--eye=0.5,1.5,-6.25", "--near=1.5", "--fit"]) == 0
        assert seen[0].fit
        assert seen[0].camera == replace(NOW.camera, eye=(0.5, 1.5, -6.25), near=1.5)
        assert main(["spheres"]) == 0
        assert seen[1] is None  # nothing to change
        assert view_command.NAME == "view"

    def test_a_viewport_stands_as_it_is_without_fit(self, monkeypatch) -> None:
        seen = []
        monkeypatch.setattr(
            "lucida.app.window.launch.run_viewer",
            lambda *_, change, **__: seen.append(change(NOW)) or 0,
        )
        for options, fit in (
            (["--viewport=-1,1,-1,1"], False),
            (["--viewport=-1,1,-1,1", "--fit"], True),
            (["--no-fit"], False),
            (["--eye=1,2,3"], True),
        ):
            assert main(options) == 0
            assert seen.pop().fit is fit

    @pytest.mark.parametrize(
        ("options", "told"),
        [
            ("--eye=1,2", "'1,2' is not 3 numbers; give e.g. 0,0,5"),
            ("--viewport=1,2,3", "is not 4 numbers; give e.g. -0.5,0.5"),
            ("--near=a", "'a' is not a number"),
            ("--w=0,0,0", "--w: (0, 0, 0) is not independent of u and v; give w a part"),
            ("--distance=nan", "--distance: nan is not finite"),
        ],
    )
    def test_a_mistake_is_one_line(
        self, tmp_path, monkeypatch, capsys, options: str, told: str
    ) -> None:
        monkeypatch.chdir(tmp_path)
        assert told in refused(capsys, "render", "spheres", "-o", "a.png", options)
