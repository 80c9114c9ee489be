"""C is compiled, Julia run, where there is a compiler for them."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

CC = shutil.which("gcc") or shutil.which("cc")
JULIA = shutil.which("julia")
needs_c = pytest.mark.skipif(CC is None, reason="no C compiler here")
needs_julia = pytest.mark.skipif(JULIA is None, reason="no Julia here")


def run_c(program: str, folder: Path) -> str:
    source, made = folder / "program.c", folder / "program"
    source.write_text(program)
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-Wno-unused-variable",
             "-Wno-unused-but-set-variable"]  # fmt: skip
    assert CC is not None
    subprocess.run([CC, *flags, "-o", made, source, "-lm"], check=True, timeout=60)
    return subprocess.run([made], check=True, capture_output=True, text=True, timeout=60).stdout


def run_julia(program: str, folder: Path) -> str:
    source = folder / "program.jl"
    source.write_text(program)
    assert JULIA is not None
    done = subprocess.run(
        [JULIA, "--startup-file=no", source], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return done.stdout
