"""The view "Your code": a student's file is run, shown, told, run again, stopped."""

import os
from dataclasses import replace
from pathlib import Path

from imgui_bundle import hello_imgui

from lucida.app.checking.tasks import Limits
from lucida.app.checking.your_code import runs
from lucida.app.checking.your_code.panel import RUNNING_S
from lucida.app.checking.your_code.view import YOUR_CODE, YourCode
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.state.paths import stored
from lucida.app.ui import layout
from lucida.app.ui.instrument import view_of

WINDOW = f"//###{YOUR_CODE}"
RIGHT = """\
def viewing_ray(i, j, width, height, camera):
    x = camera.left + (j + 0.5) / width * (camera.right - camera.left)
    y = camera.top - (i + 0.5) / height * (camera.top - camera.bottom)
    if camera.projection == "parallel":
        origin = [e + x * a + y * b for e, a, b in zip(camera.eye, camera.u, camera.v)]
        return origin, [-c for c in camera.w]
    d = camera.distance
    return camera.eye, [x * a + y * b - d * c for a, b, c in zip(camera.u, camera.v, camera.w)]
"""
CORNER = RIGHT.replace("(j + 0.5)", "j")


def view(d):
    found = d.window.views[YOUR_CODE]
    assert isinstance(found, YourCode)
    return found


def write(d, text, name="rays.py"):
    """As an editor does that puts a new file in the old one's place: its time is always another."""
    path, new = d.folder / name, d.folder / f"{name}.new"
    new.write_text(text)
    new.replace(path)
    return path


def told(d):
    """Return what the view reports now."""
    return [line.text for line in view(d).told]


def until_told(d, *parts):
    d.until(lambda: all(part in "\n".join(told(d)) for part in parts))


def opened(d, text, name="rays.py"):
    path = write(d, text, name)
    d.drop([str(path)])
    d.until(lambda: d.options.your_code.file == stored(str(path)))
    d.until(lambda: YOUR_CODE in d.stage.rects)
    return path


def drive_without_a_file_it_helps_to_begin(d):
    d.stage.show_in(YOUR_CODE, layout.LOOPS)
    d.until(lambda: YOUR_CODE in d.stage.rects and not d.window.is_rearranging)
    d.click(f"{WINDOW}/Write a file to begin with...")
    dialog = d.files.dialog
    if dialog.is_open:  # the window's own: there is no system's here
        dialog.cancel()
    view(d).write_starter(str(d.folder / "begun.py"))
    d.until(lambda: d.options.your_code.file == stored(str(d.folder / "begun.py")))
    until_told(d, "viewing_ray returns nothing yet")


def drive_a_right_file_is_told_right_and_follows_the_camera(d):
    opened(d, RIGHT)
    until_told(d, "Every ray is correct.", "viewing-ray: correct")
    d.settle()
    pictures = view(d).pictures.pictures
    assert pictures.size == (32, 24)
    assert (pictures.given == pictures.right).all()
    before = pictures.given
    d.change(your_code={"canvas": (16, 12)})
    shown = view(d).pictures
    d.until(lambda: shown.pictures is not None and shown.pictures.size == (16, 12))
    state = d.state
    d.window.change(state.with_view(d.start.scene.view))
    parallel = replace(state.camera, projection="parallel")
    d.window.change(d.state.with_camera(parallel))
    d.until(lambda: view(d).runs.report is not None and view(d).runs.report.rays.camera.is_parallel)
    until_told(d, "Every ray is correct.")
    d.settle()
    assert shown.pictures.size == (16, 12)
    assert before.shape == (24, 32, 3)
    d.window.open("spheres")
    d.until(lambda: d.state.scene.name == "spheres")
    d.settle()


def drive_a_wrong_file_is_told_by_name_and_again_when_it_is_saved(d):
    opened(d, CORNER)
    until_told(d, "768 of 768 rays are wrong.", "half a pixel")
    d.settle()
    outside = view_of(d.window.views.values(), OutsideView)
    assert any(item.name == "second edges" for item in outside.extensions.lines)
    pictures = view(d).pictures.pictures
    assert (pictures.given != pictures.right).any()
    info = d.box(f"{WINDOW}/right")
    d.click_at((info.min.x + 1.0, info.min.y + 1.0))
    assert d.state.marked is not None
    until_told(d, "pixel (0, 0), from 0")
    write(d, RIGHT)
    until_told(d, "Every ray is correct.")
    d.until(lambda: not any(item.name == "second edges" for item in outside.extensions.lines))
    write(d, RIGHT + "\ndef broken(:\n")
    until_told(d, "SyntaxError", "line 10")
    write(d, RIGHT.replace("x = camera.left", "x = camera.lft"))
    until_told(d, "rays.py, line 2", "lft")
    (d.folder / "rays.py").unlink()
    d.until(lambda: not view(d).runs.busy)  # the button stops a run that goes on
    d.frames(2)
    d.click(f"{WINDOW}/###run")
    until_told(d, "does not exist")
    write(d, RIGHT)
    until_told(d, "Every ray is correct.")
    assert not any(item.name.startswith("second") for item in outside.extensions.lines)


def drive_an_endless_loop_holds_no_frame_up_and_is_stopped(d):
    opened(d, RIGHT.replace("    x =", "    while i == 3:\n        pass\n    x =", 1))
    its = view(d).runs
    d.until(lambda: its.running_s > 0.1)
    frames = 0
    while frames < 30:  # the window goes on meanwhile
        d.frames()
        frames += 1
    assert its.busy
    processes = children()
    assert processes
    d.until(lambda: its.running_s > RUNNING_S)
    d.frames(2)
    d.click(f"{WINDOW}/###stop")
    until_told(d, "was stopped", "not run again by itself: choose fewer pixels")
    d.until(lambda: not its.busy)
    d.until(lambda: not (children() & processes))
    version = view(d).runs.report.question.version
    camera = d.state.camera
    d.window.change(d.state.with_camera(replace(camera, distance=2.0 * camera.distance)))
    d.frames(10)
    assert not its.busy  # not by itself
    assert view(d).runs.report.question.version == version
    d.change(your_code={"canvas": (4, 3)})
    until_told(d, "Every ray is correct.")  # it has no fourth row
    write(d, RIGHT)
    until_told(d, "Every ray is correct.")
    d.until(lambda: view(d).runs.report.question.version > version)


def drive_nothing_runs_that_nobody_sees(d):
    usual, runs.LIMITS = runs.LIMITS, Limits(seconds=10_000.0)  # not by itself
    opened(d, RIGHT.replace("    x =", "    while i == 3:\n        pass\n    x =", 1))
    d.until(lambda: view(d).runs.running_s > 0.1)
    processes = children()
    assert processes
    hello_imgui.switch_layout(layout.LAYOUTS[0].name)
    d.until(lambda: YOUR_CODE not in d.stage.rects)
    d.until(lambda: not (children() & processes))
    runs.LIMITS = usual
    write(d, RIGHT)
    d.stage.show_in(YOUR_CODE, layout.LOOPS)
    until_told(d, "Every ray is correct.")


def drive_a_file_that_a_lecture_names_is_not_run_unasked(d):
    ran = d.folder / "ran"
    ran.unlink(missing_ok=True)
    d.files.recent.clear()  # it was opened where the folder has been used before
    write(d, f"open({str(ran)!r}, 'w').close()\n{RIGHT}", "theirs.py")
    lecture = d.folder / "lecture.toml"
    lecture.write_text(
        'title = "Code"\n[[steps]]\ntitle = "yours"\nviews = ["your-code"]\n'
        'options.your_code.file = "theirs.py"\noptions.your_code.canvas = [16, 12]\n'
    )
    d.files.open(str(lecture))
    d.until(lambda: d.options.your_code.file == stored(str(d.folder / "theirs.py")))
    d.until(lambda: YOUR_CODE in d.stage.rects)
    d.settle()
    assert not view(d).runs.busy and view(d).runs.report is None and not ran.exists()
    d.click(f"{WINDOW}/Run it")
    until_told(d, "Every ray is correct.")
    assert ran.exists()


def children():
    """The processes that this one has begun, where that can be known."""
    found = set()
    for entry in Path("/proc").glob("[0-9]*/stat"):
        try:
            words = entry.read_text().rpartition(")")[2].split()
            command = (entry.parent / "cmdline").read_bytes()
        except OSError:
            continue
        if int(words[1]) == os.getpid() and b"class StudentFile" in command and words[0] != "Z":
            found.add(int(entry.parent.name))
    return found
