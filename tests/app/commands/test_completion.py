"""Completion in shells, asked of bash where it is installed."""

from __future__ import annotations

import shutil
import subprocess

import pytest

from lucida.app.cli import main
from lucida.app.commands.completion import SHELLS

ASK = """
words=("$@"); COMP_WORDS=("${words[@]}"); COMP_CWORD=$((${#words[@]}-1)); _shtab_lucida
printf '%s\\n' "${COMPREPLY[@]}"
"""


@pytest.mark.skipif(not shutil.which("bash"), reason="bash is not installed")
@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        (("rend",), ["render"]),
        (("--proj",), ["--projection"]),
        (("render", "--rend"), ["--renderer"]),
        (("render", "--renderer", ""), ["raster", "ray"]),
        (("render", "bu"), ["bunny.obj"]),
        (("completion", ""), sorted(SHELLS)),
    ],
)
def test_bash_completes_commands_options_values_and_files(
    words, wanted, capsys, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bunny.obj").touch()
    assert main(["completion", "bash"]) == 0
    script = capsys.readouterr().out
    assert script.endswith("complete -o default -F _shtab_lucida lucida\n")
    command = ["bash", "-c", script + ASK, "bash", "lucida", *words]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert not done.stderr
    assert sorted(done.stdout.split()) == wanted


@pytest.mark.parametrize("shell", SHELLS)
def test_every_shells_script_has_every_command(shell, capsys):
    from lucida.app.commands import COMMANDS

    assert main(["completion", shell]) == 0
    script = capsys.readouterr().out
    assert all(command.NAME in script for command in COMMANDS)
