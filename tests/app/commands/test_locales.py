"""Decimal commas in the system's locale change nothing in what is read or written."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = """
import locale, sys
locale.setlocale(locale.LC_ALL, "")
assert locale.localeconv()["decimal_point"] == sys.argv[1]
from lucida.app.cli import main
sys.exit(max(main(line.split()) for line in sys.argv[2:]))
"""


@pytest.fixture
def german(tmp_path: Path) -> dict[str, str]:
    """Return an environment with a locale that was made for this test."""
    made = tmp_path / "locales" / "de_DE.UTF-8"
    made.parent.mkdir()
    if not shutil.which("localedef"):
        pytest.skip("no localedef")
    command = ["localedef", "-i", "de_DE", "-f", "UTF-8", str(made)]
    if subprocess.run(command, capture_output=True, check=False).returncode or not made.is_dir():
        pytest.skip("no sources of locales")
    return os.environ | {"LOCPATH": str(made.parent), "LC_ALL": "de_DE.UTF-8"}


def test_files_are_the_same_in_a_locale_with_decimal_commas(
    german: dict[str, str], tmp_path: Path
) -> None:
    lines = [
        "camera spheres.toml --to opencv -o {0}.yml --size 64x48",
        "camera {0}.yml -o {0}.toml",
        "export spheres -o {0}.glb",
        "render spheres -o {0}.png --size 64x48 --eye 0.5,1.25,4",
    ]
    (tmp_path / "spheres.toml").write_text("[camera]\neye = [0.5, 1.25, 4.5]\ndistance = 1.5\n")
    english = os.environ | {"LC_ALL": "C"}
    for name, point, environment in (("plain", ".", english), ("comma", ",", german)):
        command = [sys.executable, "-c", PROGRAM, point, *(line.format(name) for line in lines)]
        subprocess.run(command, cwd=tmp_path, env=environment, check=True)
    for ending in (".yml", ".toml", ".glb", ".png"):
        plain, comma = ((tmp_path / f"{name}{ending}").read_bytes() for name in ("plain", "comma"))
        assert plain == comma
