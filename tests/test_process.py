"""The process of a command: closed streams, and Ctrl-C while modules are imported."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="POSIX's streams and signals")

INTERRUPTED_IMPORT = """\
import os, signal, time
os.kill(os.getpid(), signal.SIGINT)
time.sleep(0.1)
finished = True
"""
IMPORTER = """\
import time
from app.process import interrupt_between_imports
interrupt_between_imports()
try:
    import interrupted
    time.sleep(60)
except KeyboardInterrupt:
    print(interrupted.finished)
"""


def run(*arguments, closed=(), **options):
    """Python with some of its standard streams closed."""

    def close():
        for descriptor in closed:
            os.close(descriptor)

    path = os.pathsep.join([str(ROOT), *filter(None, sys.path), "."])
    return subprocess.run(
        [sys.executable, *arguments],
        env={**os.environ, "PYTHONPATH": path},
        preexec_fn=close,
        text=True,
        timeout=50,
        check=False,
        **options,
    )


@pytest.mark.parametrize("closed", [(1,), (2,), (0, 1, 2)])
def test_closed_streams_are_nobodys(tmp_path, closed):
    line = "-m app render spheres -o a.png --size 8x8"
    end = run(*line.split(), closed=closed, cwd=tmp_path)
    assert end.returncode == 0
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_what_would_go_to_a_closed_standard_error_goes_nowhere(tmp_path):
    end = run("-m", "app", "nosuch", closed=(2,), stdout=subprocess.PIPE, cwd=tmp_path)
    assert end.returncode == 2
    assert not end.stdout


def test_ctrl_c_waits_for_an_import(tmp_path):
    (tmp_path / "interrupted.py").write_text(INTERRUPTED_IMPORT)
    end = run("-c", IMPORTER, stdout=subprocess.PIPE, cwd=tmp_path)
    assert end.returncode == 0
    assert end.stdout == "True\n"
