"""Runs the tests that need OpenGL on EGL and on OSMesa, one after the other.

`make test` runs them on the first platform that works.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).parents[2]
ROOMS = (
    "renderer/raster", "renderer/compare", "renderer/editing", "parity", "app/images",
    "app/instruments/outside", "app/instruments/laboratory",
)  # fmt: skip


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="platforms", description=__doc__)
    parser.add_argument("--minutes", type=float, help="accepted; the tests are not divided")
    _, rest = parser.parse_known_args(argv)
    rooms = [f"tests/{room}" for room in ROOMS]
    command = [sys.executable, "-m", "pytest", "-q", "-n", "auto", *rooms, "-k", "osmesa", *rest]
    environment = os.environ | {"LUCIDA_PLATFORMS": "egl osmesa", "CI": "1"}
    return subprocess.run(command, cwd=ROOT, env=environment).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
