"""Runs the tests that need OpenGL on EGL and on OSMesa, one after the other.

`make test` runs them on the first platform that works.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).parents[2]
ROOMS = ("raster", "parity", "scene_editing", "images", "outside", "costs", "laboratory")


def main(argv: Sequence[str]) -> int:
    rooms = [f"tests/{room}" for room in ROOMS]
    command = [sys.executable, "-m", "pytest", "-q", "-n", "auto", *rooms, "-k", "osmesa", *argv]
    environment = os.environ | {"LUCIDA_PLATFORMS": "egl osmesa", "CI": "1"}
    return subprocess.run(command, cwd=ROOT, env=environment).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
