"""Cameras as command lines: copied as shells take them, and pasted."""

from __future__ import annotations

import shlex
from dataclasses import replace

import pytest
from copied_views import NOW, read_view, subject

from lucida.app.cameras.text import as_text, command_line
from lucida.app.cli import main
from lucida.app.commands import view as view_command
from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import View


def test_a_path_that_is_no_text_is_written_as_shells_write_bytes() -> None:
    text = command_line(View(Camera()), "a 'b'\\\n\udcff.obj")
    assert text.startswith(r"lucida render $'a \'b\'\\\n\xff.obj' -o image.png")
    assert command_line(View(Camera()), "a 'b'").split(" --")[0] == (
        """lucida render 'a '"'"'b'"'"'' -o image.png"""
    )


class TestCommandLine:
    """The command line accepts what was copied."""

    VIEW = View(
        Camera(
            eye=(0.5, 1.5, -6.25),
            u=(-1.0, 0.125, 0.0),
            w=(0.0, -1e-05, -1.0),
            viewport=(-0.8, 0.7, -0.5, 0.5),
            near=1.5,
        ),
        fit=True,
    )

    def test_the_window_takes_it_too(self, monkeypatch) -> None:
        seen = []
        monkeypatch.setattr(
            "lucida.app.window.launch.run_viewer",
            lambda *_, change, **__: seen.append(change and change(NOW)) or 0,
        )
        words = shlex.split(as_text("command line", subject(self.VIEW)))
        options = [word for word in words if word.startswith("--")]
        assert main(["spheres", *options]) == 0
        assert seen[0].fit
        assert seen[0].camera == replace(self.VIEW.camera, far=None)
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
    def test_a_mistake_is_one_line(self, capsys, options: str, told: str) -> None:
        assert main(["render", "spheres", "-o", "a.png", options]) == 2
        line = capsys.readouterr().err
        assert told in line
        assert line.count("\n") == 1


def test_of_a_command_line_only_whole_options_of_the_camera_count() -> None:
    camera = read_view("lucida scene#1.toml --eye 1,2,3 --dist 7", NOW).camera
    assert camera == replace(NOW.camera, eye=(1.0, 2.0, 3.0))
