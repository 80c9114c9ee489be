"""Completion in shells: asked of the shells themselves, where they are installed."""

from __future__ import annotations

import shutil
import subprocess

import pytest

from app.cli import main
from app.commands.completion import SHELLS
from renderer.scene import BUILTIN_SCENES

BASH = """
words=("$@"); COMP_WORDS=("${words[@]}"); COMP_CWORD=$((${#words[@]}-1)); _lucida
printf '%s\\n' "${COMPREPLY[@]}"
"""
FISH = 'complete -C "$argv" | string replace -r "\\t.*" ""'
CASES = (
    (("lucida", "rend"), ["render"]),
    (("lucida", BUILTIN_SCENES[0][:7]), [BUILTIN_SCENES[0]]),
    (("lucida", "--proj"), ["--projection"]),
    (("lucida", "render", "--rend"), ["--renderer"]),
    (("lucida", "render", "--renderer", ""), ["raster", "ray"]),
    (("lucida", "completion", ""), sorted(SHELLS)),
)


@pytest.fixture
def script(capsys, tmp_path, monkeypatch):
    """Returns a shell's script; it is asked in an empty folder."""
    monkeypatch.chdir(tmp_path)

    def of(shell: str) -> str:
        if not shutil.which(shell):
            pytest.skip(f"{shell} is not installed")
        assert main(["completion", shell]) == 0
        return capsys.readouterr().out

    return of


def _answer(*command: str) -> list[str]:
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    assert not done.stderr
    return sorted(filter(None, done.stdout.splitlines()))


def test_bash(script):
    text = script("bash")
    for words, wanted in CASES:
        assert _answer("bash", "-c", text + BASH, "bash", *words) == wanted, words
    assert _answer("bash", "-c", text + BASH, "bash", "lucida", "render", "s") == []  # files


def test_fish(script):
    text = script("fish")
    for words, wanted in CASES:
        assert _answer("fish", "-N", "-c", text + FISH, " ".join(words)) == wanted, words


def test_zsh(script):
    """It takes bash's. compdef is what compinit, which takes seconds, would define."""
    compdef = 'compdef() { print "$*"; }; '
    told = _answer("zsh", "-fc", compdef + script("zsh"))
    assert told == ["_bash_complete -o default -F _lucida lucida"]
