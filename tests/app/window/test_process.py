"""The process of a command: closed streams, Ctrl-C while modules are imported, a lost terminal."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from waiting import PATIENT_S, is_running, wait_for

ROOT = Path(__file__).parents[3]
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="POSIX's streams and signals")


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
        check=False,
        **options,
    )


def test_closed_streams_are_nobodys(tmp_path):
    line = "-m lucida render spheres -o a.png --size 8x8"
    end = run(*line.split(), closed=(0, 1, 2), cwd=tmp_path)
    assert end.returncode == 0
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


def test_what_would_go_to_a_closed_standard_error_goes_nowhere(tmp_path):
    end = run("-m", "lucida", "scene", "nosuch", closed=(2,), stdout=subprocess.PIPE, cwd=tmp_path)
    assert end.returncode == 2
    assert not end.stdout


# What `lucida` does, with Ctrl-C at its first import: that is when sys.meta_path is asked.
AT_AN_IMPORT = """\
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
wanted = sys.argv[1]
class Interrupter:
    def find_spec(self, name, path=None, target=None):
        if name == wanted:
            sys.meta_path.remove(self)
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Interrupter())
from lucida.__main__ import main
sys.argv[1:] = ["scene"]
sys.exit(main())
"""


@pytest.mark.parametrize(
    "name", ["lucida.app.window.process", "argparse", "lucida.app.commands.view"]
)
def test_ctrl_c_during_the_first_imports_is_quiet(tmp_path, name):
    end = run("-c", AT_AN_IMPORT, name, stderr=subprocess.PIPE, cwd=tmp_path)
    assert end.returncode in (130, -signal.SIGINT)
    assert end.stderr == ""


def test_ctrl_c_after_the_work_is_quiet(tmp_path):
    script = """\
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
from lucida.__main__ import main
sys.argv[1:] = ["scene"]
status = main()
os.kill(os.getpid(), signal.SIGINT)  # as while Python ends
"""
    end = run("-c", script, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=tmp_path)
    assert end.returncode == -signal.SIGINT
    assert end.stderr == ""
    assert "spheres" in end.stdout


def test_where_ctrl_c_is_ignored_it_stays_so(tmp_path):
    script = """\
import signal, sys
from lucida.__main__ import main
signal.signal(signal.SIGINT, signal.SIG_IGN)
sys.argv[1:] = ["scene"]
main()
sys.exit(signal.getsignal(signal.SIGINT) != signal.SIG_IGN)
"""
    end = run("-c", script, stdout=subprocess.PIPE, cwd=tmp_path)
    assert end.returncode == 0


# A child that tells its number when it begins, and would never end.
LONG_IMPORT = """\
import os, pathlib, time
pathlib.Path("pid.new").write_text(str(os.getpid()))
os.rename("pid.new", "pid")
time.sleep(600)
"""
PARENT = """\
import signal, sys, time
signal.signal(signal.SIGHUP, signal.SIG_DFL)
from lucida.renderer.system.child import start_child
child = start_child(sys.executable, "long_import")
time.sleep(600)
"""


def test_a_child_that_still_imports_ends_with_a_parent_that_lost_its_terminal(tmp_path):
    (tmp_path / "long_import.py").write_text(LONG_IMPORT)
    (tmp_path / "here").mkdir()  # children do not search the current folder
    path = os.pathsep.join([str(ROOT), str(tmp_path)])
    parent = subprocess.Popen(
        [sys.executable, "-c", PARENT],
        cwd=tmp_path / "here",
        env={**os.environ, "PYTHONPATH": path},
    )
    try:
        wait_for((tmp_path / "here" / "pid").exists)
        child = int((tmp_path / "here" / "pid").read_text())
        parent.send_signal(signal.SIGHUP)
        assert parent.wait(PATIENT_S) == -signal.SIGHUP
        wait_for(lambda: not is_running(child))
    finally:
        parent.kill()
        parent.wait()
