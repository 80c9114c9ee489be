"""`lucida install-desktop`: its files, read by the programs that they are for."""

from __future__ import annotations

import configparser
import shlex
import shutil
import subprocess
import sys
import xml.etree.ElementTree

import pytest

from app.cli import main
from app.commands import COMMANDS, install_desktop

linux = pytest.mark.skipif(sys.platform in ("darwin", "win32"), reason="desktops of Linux")


@pytest.fixture
def data(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "share"))
    return tmp_path / "share"


def _files(folder):
    return {path for path in folder.rglob("*") if path.is_file() and path.suffix != ".cache"}


@linux
def test_what_is_written_is_removed(data, capsys):
    assert main(["install-desktop"]) == 0
    written = _files(data)
    assert capsys.readouterr().out.splitlines() == [f"wrote {path}" for path in _in_order(data)]
    assert written == set(_in_order(data))
    assert main(["install-desktop", "--remove"]) == 0
    assert not _files(data)
    assert capsys.readouterr().out.count("removed ") == len(written)
    assert main(["install-desktop", "--remove"]) == 0
    assert capsys.readouterr().out == f"nothing of Lucida is in {data}\n"


def _in_order(data):
    return [data / name for name in install_desktop.desktop_files(data, {})]


@linux
def test_the_entry_starts_the_command_of_this_python(data):
    assert main(["install-desktop"]) == 0
    file = data / "applications" / "lucida.desktop"
    entry = configparser.ConfigParser(interpolation=None)
    entry.optionxform = str
    entry.read(file, "utf-8")
    program, argument = shlex.split(entry["Desktop Entry"]["Exec"])
    assert argument == "%f"
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
    assert version.stdout.startswith("lucida ")
    icon = data / "icons/hicolor/scalable/apps" / f"{entry['Desktop Entry']['Icon']}.svg"
    assert xml.etree.ElementTree.parse(icon).getroot().tag.endswith("svg")
    if shutil.which("desktop-file-validate"):
        checked = subprocess.run(["desktop-file-validate", file], capture_output=True, text=True)
        assert checked.returncode == 0, checked.stdout
        assert not checked.stdout


@pytest.mark.parametrize(
    ("path", "written"),
    [
        ("/opt/a b/lucida", '"/opt/a b/lucida"'),
        ('/a$b`c"d/50%', r'"/a\\$b\\`c\\"d/50%%"'),
        (r"/a\b", r'"/a\\\\b"'),
    ],
)  # as the Desktop Entry specification has it: backslashes twice, once for the argument
def test_characters_that_exec_keeps_for_itself(path, written):
    assert install_desktop.quoted(path) == written


@linux
def test_the_man_page_has_every_command(data):
    assert main(["install-desktop"]) == 0
    page = data / "man" / "man1" / "lucida.1"
    text = page.read_text("utf-8")
    for command in COMMANDS:
        assert f'\n.SH "LUCIDA {command.NAME.upper()}"\n' in text
    if shutil.which("groff"):
        shown = subprocess.run(
            ["groff", "-man", "-ww", "-Tutf8", "-P-c", page], capture_output=True, text=True
        )
        assert not shown.stderr
        assert "--screenshot OUT.png" in shown.stdout


@pytest.mark.parametrize("system", ["darwin", "win32"])
def test_elsewhere_one_line_says_what_to_do(data, capsys, monkeypatch, system):
    monkeypatch.setattr(install_desktop.sys, "platform", system)
    assert main(["install-desktop"]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "start `lucida` in a terminal" in told
    assert not data.exists()
