"""Where decimals have commas: the user's locale changes no file and no image."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from lucida.app.cli import main
from lucida.app.ui.explaining.arithmetic import number
from lucida.renderer.system.errors import LucidaError
from tests.support.needed import absent
from tests.support.refusals import refused

COMMANDS = (
    "render still-life -o image.npy --size 8x6 --fov 40.5",
    "export spheres -o scene.glb",
    "camera view.toml --to opencv -o camera.yml --size 8x6",
    "camera camera.yml --to gltf -o camera.gltf",
)
VIEW = "lucida = 1\n[camera]\neye = [0.5, 1.25, 6.5]\n"
GERMAN = "de_DE.UTF-8"
PROGRAM = """
import locale, sys
locale.setlocale(locale.LC_ALL, "")
assert locale.format_string("%.1f", 0.5) == "0,5"
from lucida.app.cli import main
sys.exit(max(main(line.split()) for line in sys.argv[1:]))
"""


@pytest.fixture
def german(tmp_path):
    """The environment of a user whose decimals have commas."""
    made = tmp_path / "locales" / GERMAN
    made.parent.mkdir()
    program, source = shutil.which("localedef"), Path("/usr/share/i18n/locales/de_DE")
    if program is None or not source.exists():
        absent("no localedef, or not its source of German")
    letters = r"(?s)\nLC_(COLLATE|CTYPE)\n.*?\nEND"  # take long, and are not used here
    text = re.sub(letters, r'\nLC_\1\ncopy "POSIX"\nEND', source.read_text("utf-8"))
    (tmp_path / "german").write_text(text, "utf-8")
    command = [program, "-i", tmp_path / "german", "-f", "UTF-8", made]
    subprocess.run(command, check=True, capture_output=True)
    return {**os.environ, "LOCPATH": str(made.parent), "LC_ALL": GERMAN}


def test_what_is_written_and_read_is_the_same(tmp_path, german, monkeypatch):
    written = []
    for name in ("here", "there"):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "view.toml").write_text(VIEW)
        monkeypatch.chdir(folder)
        if name == "here":
            assert [main(line.split()) for line in COMMANDS] == [0] * len(COMMANDS)
        else:
            command = [sys.executable, "-P", "-c", PROGRAM, *COMMANDS]
            done = subprocess.run(command, env=german, capture_output=True, text=True)
            assert (done.returncode, done.stderr) == (0, "")
        written.append({path.name: path.read_bytes() for path in folder.iterdir()})
    assert len(written[0]) == 1 + len(COMMANDS)
    assert written[0] == written[1]


@pytest.mark.parametrize("text", ["1,5", "-0,25", "1.234,5"])
def test_a_typed_comma_is_refused_with_the_point_as_the_remedy(text):
    with pytest.raises(LucidaError, match="is not a number; give one such as 0\\.25"):
        number(text)


def test_a_comma_in_a_model_names_the_line(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 0,5 0 0\nv 0 1 0\nf 1 2 3\n")
    assert "a.obj: line 2: 'v 0,5 0 0'" in refused(capsys, "scene", str(tmp_path / "a.obj"))
