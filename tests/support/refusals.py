"""Check a refusal of the command line for what every one must have."""

import re
from pathlib import Path

import pytest

from lucida.app.cli import main


def refused(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """Run the command, which must refuse: exit status 2, one line on standard error with what is
    wrong and a remedy, nothing on standard output, and no file of the current folder, which is the
    test's own, written, changed or deleted. Return the line, without the program's name.
    """
    assert not Path("pyproject.toml").exists(), "others write here: chdir first"
    before = _files()
    assert main([*words]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    line = re.fullmatch(r"lucida(?:: | [a-z]+: |: error: )([^\n]+)\n", err)
    assert line, err
    assert line[1].isprintable()
    assert "internal error" not in err
    by_argparse = r"\(choose from |is required|are required|not allowed with"
    assert re.search(rf"[^;]; \S|{by_argparse}", line[1]), err
    assert _files() == before
    return line[1]


def _files() -> dict[Path, int]:
    return {path: path.lstat().st_mtime_ns for path in Path().rglob("*")}
