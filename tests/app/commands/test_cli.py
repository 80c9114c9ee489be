"""The command line as its users meet it: arguments, one line for every mistake, exit status."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from argparse import ArgumentParser, ArgumentTypeError
from pathlib import Path

import pytest
from launching import launch

from lucida import __version__
from lucida.app.cli import main
from lucida.app.commands import COMMANDS, arguments, render, view
from lucida.renderer.files import BUILTIN_SCENES
from tests.support.refusals import refused

NAMES = [command.NAME for command in COMMANDS]
VIEW = """\
[camera]
eye = [0.0, 0.0, 5.0]
u = [1.0, 0.0, 0.0]
v = [0.0, 1.0, 0.0]
w = {w}
distance = 1.0
viewport = [-0.5, 0.5, -0.5, 0.5]
projection = "perspective"
"""


@pytest.fixture(autouse=True)
def in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("LUCIDA_TRACEBACK", raising=False)
    return tmp_path


class TestHelp:
    @pytest.mark.parametrize("arguments", [[], *[[name] for name in NAMES]])
    def test_help_is_printed_with_an_example(self, capsys, arguments):
        assert main([*arguments, "--help"]) == 0
        told = capsys.readouterr()
        assert not told.err
        assert "example" in told.out
        assert all(len(line) <= 100 for line in told.out.splitlines())

    def test_the_window_s_names_every_command(self, capsys):
        main(["--help"])
        told = capsys.readouterr().out
        assert all(f"lucida {name} " in told for name in NAMES)

    def test_version_prints_the_package_s(self, capsys):
        assert main(["--version"]) == 0
        assert capsys.readouterr().out == f"lucida {__version__}\n"

    @pytest.mark.parametrize("arguments", [["--version"], ["--help"], ["render", "--help"]])
    def test_nothing_heavy_is_loaded_for_it(self, arguments):
        program = (
            "import sys; from lucida.app.cli import main; main(sys.argv[1:]);"
            "print(*(name.partition('.')[0] for name in sys.modules), sep='\\n', file=sys.stderr)"
        )
        # The project's own place, for a run without an installation.
        path = os.pathsep.join(filter(None, sys.path))
        end = subprocess.run(
            [sys.executable, "-c", program, *arguments],
            capture_output=True,
            text=True,
            env={**os.environ, "PYTHONPATH": path},
        )
        assert end.returncode == 0
        loaded = set(end.stderr.split())
        assert "lucida" in loaded
        heavy = {"numba", "llvmlite", "moderngl", "imgui_bundle", "glfw", "trimesh", "numpy", "PIL"}
        assert not loaded & heavy


class TestWindow:
    """`lucida` without a command's name; the window itself is left out."""

    @pytest.mark.parametrize(
        ("line", "scene"),
        [
            ("", None),
            ("spheres", "spheres"),
            ("./render", "./render"),
            ("-- render", "render"),
            ("--size 640x480 render", "render"),
        ],
    )
    def test_a_line_without_a_command_opens_its_scene(self, monkeypatch, line, scene):
        seen = []
        monkeypatch.setattr(view, "run", lambda arguments: seen.append(arguments.scene) or 0)
        assert main(line.split()) == 0
        assert seen == [scene]


class TestMistakes:
    """One line on standard error that says what and the remedy, nothing else; exit status 2."""

    @pytest.mark.parametrize(
        ("line", "told"),
        [
            ("--nosuch", "unrecognized arguments: --nosuch; see 'lucida --help'"),
            ("nosuch", "nosuch"),
            ("spheres two", "unrecognized arguments: two"),
            ("--screenshot a.gif", r"a\.gif: the ending '\.gif' is unknown; give one of \.png"),
            ("--screenshot a.ppm", r"a\.ppm: \.ppm cannot hold this picture; give one of \.png"),
            ("--size 10x900", "--size: 10x900 is too small for the window; give at least 64x64"),
            ("render spheres -o a", "a: has no ending; give one of .png"),
            ("render spheres -o a.jpg", r"a\.jpg: the ending '\.jpg' is unknown"),
            ("render spheres -o no/a.png", "no/a.png: folder .* does not exist; make it first"),
            ("render spheres -o a.png --size 0x9", "--size: 0x9 has no pixels; give at least 1x1"),
            ("render spheres -o a.png --size 99999x9", "--size: 99999x9 is too large; stay within"),
            ("render spheres -o a.png --size ٣x٣", "is not a size"),
            ("render spheres -o a.png --samples 3", "--samples: '3' is not possible; give one of"),
            ("render spheres -o a.png --shadows", "argument --shadows: only image order has it"),
            ("render spheres -o a.png --mirrors 1", "add --renderer ray"),
            (
                "render spheres -o a.png --threads 2",
                "--threads: is no longer part of Lucida; Tracer",
            ),
            ("render spheres -o a.png --exposure 1e9", "'1e9' is not an exposure"),
            ("render spheres -o a.png --renderer both", "--renderer: invalid choice: 'both'"),
            ("render spheres -o a.png --backend glx", "--backend: invalid choice: 'glx'"),
            ("render nosuch -o a.png", "nosuch"),
            ("render nosuch.toml -o a.png", "nosuch.toml"),
            ("render spheres -o a.png --view flat.toml", "flat.toml: camera.w: .* independent"),
            ("render spheres -o a.png --view broken.toml", "broken.toml: "),
            ("compare spheres -o a.exr", r"a\.exr: \.exr cannot hold this picture"),
            ("compare spheres -o a.png --show signed", "--show: is no longer part of Lucida; `luc"),
            ("render spheres -o a.png --lens brown:k1", "'k1' has no value; give k1=0.1"),
            ("lecture --export x.gif", r"--export: the ending '\.gif' is unknown"),
            *(
                (f"{line} spheres", "required: -o/--output")
                for line in ("render", "animate --orbit", "export", "figure", "page")
            ),
            ("animate spheres -o a.mp4", "one of the arguments --orbit --dolly-zoom --path is req"),
            ("pick spheres", "required: ROW, COLUMN; see 'lucida pick --help'"),
            ("pick spheres 1.5 3", "argument ROW: '1.5' is not a whole number; give e.g. 12"),
            ("pick spheres 720 0", "ROW: 720 is outside an image of 1280x720; give 0 to 719"),
            ("pick spheres 0 9 --size 9x9", "COLUMN: 9 is outside an image of 9x9; give 0 to 8"),
            (
                "pick spheres 0 1 --from 1",
                "--from: is no longer part of Lucida; commands count rows",
            ),
            ("scenes all", "scenes: is no longer part of Lucida; `lucida scene` lists"),
            ("doctor --some", "unrecognized arguments: --some; see 'lucida doctor --help'"),
            ("install-desktop here", "install-desktop: is no longer part of Lucida; start lucida"),
            ("camera a.json --undistort=out", "--undistort: is no longer part of Lucida; COLMAP's"),
            (
                "lecture --results no no2 -o a.html",
                "--results: no: does not exist in",
            ),
        ],
    )
    def test_each_mistake_is_told_in_one_line(self, capsys, in_an_empty_folder, line, told):
        (in_an_empty_folder / "flat.toml").write_text(VIEW.format(w="[0.0, 0.0, 0.0]"))
        (in_an_empty_folder / "broken.toml").write_text("[camera\n")
        assert re.search(told, refused(capsys, *line.split()))

    @pytest.mark.parametrize("name", NAMES)
    def test_a_misspelt_command_names_the_one_that_is_meant(self, capsys, in_an_empty_folder, name):
        misspelt = {name[:-1], name[0] + name[2:], name[:-2] + name[-1] + name[-2], name.upper()}
        for word in misspelt - set(NAMES):
            told = refused(capsys, word, "x.obj", "-o", "a b.png")
            assert told.startswith(f"'{word}' is neither a command nor a scene; ")
            close = re.search(r"did you mean lucida ([\w-]+)( x\.obj -o 'a b\.png')?\?", told)
            assert close and close[1] == name
            assert close[2]

    def test_a_scene_s_name_that_is_like_no_command(self, monkeypatch, tmp_path):
        seen = []
        monkeypatch.setattr(view, "run", lambda arguments: seen.append(arguments.scene) or 0)
        (tmp_path / "rendr").mkdir()
        for name in ("Spheres", "colums", "x", "rendr", "rendr.obj", "bunny"):
            assert main([name]) == 0
        assert len(seen) == 6

    @pytest.mark.parametrize("name", ["a\nb", "\x1b[31m", "\udcff"])
    @pytest.mark.parametrize(
        "line", ["render {} -o a.png", "render spheres -o {}", "--size {}", "--{}"]
    )
    def test_a_name_that_a_terminal_would_obey(self, capsys, in_an_empty_folder, name, line):
        assert refused(capsys, *(part.format(name) for part in line.split()))

    def test_a_failure_inside_is_one_line_too(self, capsys, monkeypatch):
        def fail(arguments):
            raise RuntimeError("no\nluck")

        monkeypatch.setattr(render, "run", fail)
        assert main(["render", "spheres", "-o", "a.png"]) == 2
        told = capsys.readouterr().err
        assert told.startswith("lucida: internal error: RuntimeError no luck; LUCIDA_TRACEBACK=1")
        assert told.count("\n") == 1
        monkeypatch.setenv("LUCIDA_TRACEBACK", "1")
        assert main(["render", "spheres", "-o", "a.png"]) == 2
        assert "Traceback" in capsys.readouterr().err


def test_numbers_at_their_bounds_are_taken_and_others_are_not():
    whole, real = arguments.whole(1, 3, "is bad"), arguments.real(lambda x: 0 < x <= 3, "is bad")
    assert (whole("1"), whole("3"), real("3"), real("1e-3")) == (1, 3, 3.0, 0.001)
    for parse, texts in ((whole, "0 4 x -1 1.5 ٣"), (real, "0 3.1 x nan -1")):
        for text in texts.split():
            with pytest.raises(ArgumentTypeError, match=f"'{text}' is bad"):
                parse(text)


class TestEnds:
    def test_an_interrupted_command_says_so_and_ends_with_130(self, capsys, monkeypatch):
        def interrupt(arguments):
            raise KeyboardInterrupt

        monkeypatch.setattr(render, "run", interrupt)
        assert main(["render", "spheres", "-o", "a.png"]) == 130
        assert capsys.readouterr().err == "lucida: interrupted\n"

    @pytest.mark.skipif(sys.platform == "win32", reason="a reader that left is POSIX's SIGPIPE")
    def test_a_reader_that_leaves(self, tmp_path):
        end = self.printing_to("reading, out = os.pipe(); os.close(reading)", tmp_path)
        assert end.returncode == 141
        assert not end.stderr

    @pytest.mark.skipif(not os.path.exists("/dev/full"), reason="/dev/full is Linux's")
    def test_output_that_cannot_be_written(self, tmp_path):
        end = self.printing_to("out = os.open('/dev/full', os.O_WRONLY)", tmp_path)
        assert end.returncode == 2
        assert re.fullmatch("lucida: [^\n]*space[^\n]*\n", end.stderr)

    @staticmethod
    def printing_to(out: str, folder: Path) -> subprocess.CompletedProcess:
        run = "sys.stdout = open(out, 'w'); runpy.run_module('lucida', run_name='__main__')"
        return launch(["-c", f"import os, runpy, sys; {out}; {run}", "scene"], folder)

    def test_scenes_are_those_of_the_renderer(self, capsys):
        assert main(["scene"]) == 0
        assert tuple(capsys.readouterr().out.split()) == BUILTIN_SCENES


CAMERA = "view eye target up u v w distance fov viewport projection near far lens fit size"
DRAWING = {"samples": 1, "exposure": 0.0, "backend": "auto", "shadows": False, "mirrors": 0}
WORKERS = {"workers": 1, "scheduler": ""}
# The least arguments; the options that are None without a value, and what the others are.
OPTIONS = {
    "render s -o o": (CAMERA, {"renderer": "raster", "channel": "color"} | DRAWING | WORKERS),
    "animate s -o o --orbit": (
        f"{CAMERA} path seconds",
        {"orbit": True, "dolly_zoom": False, "fps": 30.0, "renderer": "raster"} | DRAWING | WORKERS,
    ),
    "compare s": (f"{CAMERA} output", {"backend": "auto", "json": False}),
    "pick s 1 2": (CAMERA, {"row": 1, "column": 2, "json": False}),
    "camera i": ("to output size pixel_origin", {"no_lens": False, "json": False}),
    "export s -o o": (CAMERA, {}),
    "figure s -o o": (
        f"{CAMERA} mark", {"what": "outside", "ground": "white", "scale": 1.0},
    ),
    "page s -o o": (CAMERA, {}),
    "check f": ("command tasks task json user python starter output", {}),
    "tasks": ("task tasks", {}),
    "lecture": (
        "file export answers results output size",
        {"step": (0, 0), "check": False, "no_answers": False, "outside": False},
    ),
}  # fmt: skip


@pytest.mark.parametrize("line", OPTIONS)
def test_options_that_are_not_given_have_their_defaults(line, monkeypatch):
    name, *given = line.split()
    (command,) = (one for one in COMMANDS if name == one.NAME)
    parser = ArgumentParser()
    command.configure(parser)
    empty, others = OPTIONS[line]
    wanted = dict.fromkeys(empty.split()) | others
    wanted |= {one: one[0] for one in ("scene", "output") if one[0] in given}
    wanted |= {key: key[0] for key in ("input", "file") if key[0] in given}
    assert vars(parser.parse_args(given)) == wanted
