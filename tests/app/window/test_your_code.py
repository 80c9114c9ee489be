"""The view "Your code" from start to start: it goes on with its file, and leaves no process."""

import sys
from pathlib import Path

import pytest
from launching import launch
from test_window import drives_take_long

SCRIPT = """
import os, sys
from pathlib import Path
from lucida.app.state.paths import stored
from stepped import session_window, stepped
from lucida.app.checking.your_code.view import YOUR_CODE

folder, mode = Path(sys.argv[1]), sys.argv[2]
code = str(folder / "rays.py") if mode == "named" else ""
options = {"your_code": {"file": stored(code)}} if code else {}
run = session_window(folder, options, code=code)
view = run.window.views[YOUR_CODE]
waited = []

def step():
    if view.runs is None:
        return
    waited.append(1)
    if mode == "unknown":  # it is shown, and is not run
        if len(waited) > 60:
            print(view.runs.report, YOUR_CODE in run.window.shell.stage.rects)
            run.params.app_shall_exit = True
    elif view.runs.running_s > 0.5 and (found := sorted(children())):  # it hangs, in the last row
        print(" ".join(found))
        run.params.app_shall_exit = True

def children():
    for entry in Path("/proc").glob("[0-9]*/stat"):
        try:
            parent = entry.read_text().rpartition(")")[2].split()[1]
            if int(parent) == os.getpid() and b"class StudentFile" in (
                entry.parent / "cmdline"
            ).read_bytes():
                yield entry.parent.name
        except OSError:
            pass

stepped(run, step)
"""
ENDLESS = """
def viewing_ray(i, j, width, height, camera):
    while i == height - 1:
        pass
    return camera.eye, (0, 0, -1)
"""


def opened(folder, mode):
    done = launch(["-c", SCRIPT, str(folder), mode], folder)
    assert done.returncode == 0, done.stderr
    return done


@drives_take_long
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="processes are looked up in /proc")
def test_closing_while_it_runs_leaves_no_process_and_the_next_start_runs_it_again(
    tmp_path,
):
    (tmp_path / "rays.py").write_text(ENDLESS)
    for mode in ("named", "again"):
        (process,) = opened(tmp_path, mode).stdout.split()
        status = Path("/proc", process, "stat")
        assert not status.exists() or status.read_text().rpartition(")")[2].split()[0] == "Z"
    # A session of a file that the user has never opened here.
    (tmp_path / "recent.json").unlink()
    assert opened(tmp_path, "unknown").stdout.split() == ["None", "True"]
