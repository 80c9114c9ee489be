"""A new instrument is a folder and a line: the one of docs/architecture.md, added to a copy of app/
as it stands there, and worked in the window."""

from __future__ import annotations

import filecmp
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
ROOT = TESTS.parent
PAGE = ROOT / "docs" / "architecture.md"
LIMIT_S = 800  # the first window may compile the tracer
pytestmark = pytest.mark.timeout(LIMIT_S + 60)

TOPIC = "added/depths"
DRIVE = (TESTS / "scenarios" / f"{TOPIC}.py").read_text("utf-8")
LECTURE = """
title = "Depths"

[[steps]]
title = "how far"
views = ["depths", "ray"]
options.depths.bars = 8
highlight = ["depths"]

[[steps]]
title = "as ever"
"""
SESSION = """
import sys
from pathlib import Path
from app.window import viewer
from app.window.platform import start_platform
from app.window.start import begin_session

folder, mode = Path(sys.argv[1]), sys.argv[2]
viewer.settings_file = lambda fresh=False: folder / "window.ini"
viewer._folder = lambda: folder
start = begin_session(folder=folder)
run = viewer.WindowRun(start_platform(want_display=False), start.state, (900, 600), start=start)
window, frames = run.window, iter(range(10**9))

def step():
    frame = next(frames)
    if frame == 5 and mode == "leave":
        window.shell.stage.show("Depths")
        window.change(window.state.with_options(depths={"bars": 20}))
    elif frame == 30:
        stage = window.shell.stage
        seen = {"Raster", "Ray", "Depths"} & set(stage.rects) or stage.maximised
        shown = "Depths" in [view.name for view in stage.shown]
        print(shown, getattr(window.state.options, "depths", None), "" if seen else "black")
        run.params.app_shall_exit = True

run.params.callbacks.post_new_frame = step
run.params.fps_idling.enable_idling = False
run.run()
"""


def _page() -> tuple[str, dict[str, str]]:
    """The registry's line, and the files, by their paths."""
    text = PAGE.read_text("utf-8").partition("## Adding an instrument")[2]
    (line,) = re.findall(r"```text\n(.*?)```\n", text, re.DOTALL)
    block = re.compile(r"```python\n(.*?)```\n", re.DOTALL)
    files = block.findall(text)
    names = re.findall(r"`(app/depths/\w+\.py)`", block.sub("", text))
    return line, dict(zip(names, files, strict=True))


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with app/ and the new instrument in it."""
    tree = tmp_path_factory.mktemp("tree")
    shutil.copytree(ROOT / "app", tree / "app")  # byte code, too: it counts by a file's time
    line, files = _page()
    for name, text in files.items():
        (tree / name).parent.mkdir(exist_ok=True)
        (tree / name).write_text(text, "utf-8")
    registry = tree / "app" / "instruments.py"
    before = registry.read_text("utf-8")
    assert before.endswith('    Room("app.lecture"),\n)\n')
    registry.write_text(before.removesuffix(")\n") + line + ")\n", "utf-8")
    return tree


def run(tree: Path, folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Python with the app of a tree; no display, no settings of whoever runs the tests."""
    names = ("DISPLAY", "WAYLAND_DISPLAY")
    variables = {name: value for name, value in os.environ.items() if name not in names}
    variables |= {
        "XDG_CONFIG_HOME": str(folder / "config"),
        "PYTHONPATH": os.pathsep.join(map(str, (tree, ROOT))),
    }
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=folder,
        env=variables,
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
    )


def test_nothing_else_is_edited(tree: Path) -> None:
    found = [filecmp.dircmp(ROOT / "app", tree / "app", ignore=["__pycache__"])]
    for one in found:
        found += one.subdirs.values()
    assert [name for one in found for name in one.right_only] == ["depths"]
    assert [name for one in found for name in one.diff_files] == ["instruments.py"]
    before, after = ((root / "app/instruments.py").read_text("utf-8") for root in (ROOT, tree))
    assert len(after.splitlines()) == len(before.splitlines()) + 1


def test_it_stands_on_its_floor(tree: Path, tmp_path: Path) -> None:
    """The tests of the layers, on the copy."""
    (tree / "tests" / "project").mkdir(parents=True)
    shutil.copy(TESTS / "project" / "test_layers.py", tree / "tests" / "project")
    plain = ("-q", "-rA", "-p", "no:cacheprovider", "-c", os.devnull, "--rootdir", str(tree))
    layers = str(tree / "tests" / "project" / "test_layers.py")
    done = run(
        tree,
        tmp_path,
        "-m",
        "pytest",
        *plain,
        "-k",
        "depths or circle or regis or point_down or draw_nothing",
        layers,
    )
    assert done.returncode == 0, done.stdout[-3000:]
    assert set(re.findall(r"^PASSED .*::(.*)$", done.stdout, re.MULTILINE)) >= {
        "test_imports_point_down",
        "test_cores_draw_nothing",
        "test_options_know_the_state_alone[app.depths.options]",
        "test_every_instrument_is_registered",
        "test_no_files_import_each_other_in_a_circle",
    }


@pytest.fixture(scope="module")
def driven(tree: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    folder = tmp_path_factory.mktemp("driven")
    (folder / "lecture.toml").write_text(LECTURE)
    report = folder / "report.json"
    done = run(
        tree, folder, str(TESTS / "support" / "window_driver.py"), str(report), str(folder), TOPIC
    )
    assert done.returncode == 0 and report.exists(), done.stdout[-2000:] + done.stderr[-2000:]
    results: dict[str, str] = json.loads(report.read_text())
    return results


@pytest.mark.parametrize("name", re.findall(r"^def (drive_\w+)", DRIVE, re.MULTILINE))
def test_in_the_window(driven: dict[str, str], name: str) -> None:
    assert driven[name] == ""


def test_a_session_keeps_its_option(tree: Path, tmp_path: Path) -> None:
    def window(tree: Path, mode: str) -> str:
        done = run(tree, tmp_path, "-c", SESSION, str(tmp_path), mode)
        assert done.returncode == 0, done.stderr
        return done.stdout.strip()

    session, broken = tmp_path / "session-1.json", tmp_path / "session-1.broken-1.json"
    assert window(tree, "leave") == "True DepthsOptions(bars=20)"
    left = session.read_bytes()
    table = json.loads(left)
    assert table["options"]["depths"] == {"bars": 20}
    assert window(tree, "go on") == "True DepthsOptions(bars=20)"
    # One that was left with it is read without it, and the other way round.
    elsewhere = json.loads(left)
    elsewhere["arrangement"] |= {"maximised": "Depths", "focused": "Depths"}
    session.write_text(json.dumps(elsewhere))
    assert window(ROOT, "go on") == "False None"
    assert "depths" not in json.loads(session.read_bytes())["options"]
    assert window(tree, "go on") == "False DepthsOptions(bars=16)"
    assert not broken.exists()
    # Beyond its bounds it is refused, as every option is.
    table["options"]["depths"]["bars"] = 65
    session.write_text(json.dumps(table))
    assert window(tree, "go on").endswith("DepthsOptions(bars=16)")
    assert broken.exists()


@pytest.mark.parametrize(
    ("bars", "told"), [(8, ""), (65, "options.depths.bars: 65 is out of range; give 4 to 64")]
)
def test_lectures_know_it_and_its_bounds(tree: Path, tmp_path: Path, bars: int, told: str) -> None:
    file = tmp_path / "lecture.toml"
    file.write_text(LECTURE.replace("bars = 8", f"bars = {bars}"))
    done = run(tree, tmp_path, "-m", "app", "lecture", str(file), "--check")
    assert done.returncode == (2 if told else 0), done.stderr
    assert told in done.stderr
