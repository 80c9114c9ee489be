"""The view "Your code" from start to start: it goes on with its file, and leaves no process."""

from launching import launch
from test_window import drives_take_long
from waiting import is_running

SCRIPT = """
import sys
from contextlib import suppress
from pathlib import Path
import psutil
from lucida.app.state.paths import stored
from stepped import session_window, stepped
from lucida.app.checking.your_code.view import YOUR_CODE

folder, mode = Path(sys.argv[1]), sys.argv[2]
code = str(folder / "rays.py") if mode == "named" else ""
options = {"your_code": {"file": stored(code)}} if code else {}
run = session_window(folder, options, code=code)
view = run.window.views[YOUR_CODE]

def step():
    if mode == "unknown":  # it is shown, and is not run
        if view.runs.busy or (view.seen and run.window.settled):
            print(view.runs.busy, view.runs.report, YOUR_CODE in run.window.shell.stage.rects)
            run.params.app_shall_exit = True
    elif (folder / "hangs").exists() and (found := list(children())):
        print(*found)
        run.params.app_shall_exit = True

def children():
    for child in psutil.Process().children():
        with suppress(psutil.Error):  # it has ended meanwhile
            if "class StudentFile" in " ".join(child.cmdline()):
                yield str(child.pid)

stepped(run, step)
"""
ENDLESS = """
def viewing_ray(i, j, width, height, camera):
    while i == height - 1:
        open("hangs", "w").close()
    return camera.eye, (0, 0, -1)
"""


def opened(folder, mode):
    done = launch(["-c", SCRIPT, str(folder), mode], folder)
    assert done.returncode == 0, done.stderr
    return done


@drives_take_long
def test_closing_while_it_runs_leaves_no_process_and_the_next_start_runs_it_again(
    tmp_path,
):
    (tmp_path / "rays.py").write_text(ENDLESS)
    for mode in ("named", "again"):
        (process,) = opened(tmp_path, mode).stdout.split()
        assert not is_running(int(process))
        (tmp_path / "hangs").unlink()
    # A session of a file that the user has never opened here.
    (tmp_path / "recent.json").unlink()
    assert opened(tmp_path, "unknown").stdout.split() == ["False", "None", "True"]
