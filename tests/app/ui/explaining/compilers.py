"""Julia is run where it is installed."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

JULIA = shutil.which("julia")
needs_julia = pytest.mark.skipif(JULIA is None, reason="no Julia here")


def run_julia(program: str, folder: Path) -> str:
    source = folder / "program.jl"
    source.write_text(program)
    assert JULIA is not None
    done = subprocess.run(
        [JULIA, "--startup-file=no", source], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return done.stdout
