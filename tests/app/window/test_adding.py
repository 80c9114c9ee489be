"""The instrument of docs/architecture.md, built from that text and opened in the window."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from launching import SUPPORT, environment
from test_window import one_window

ROOT = Path(__file__).parents[3]
MOST_LINES = 60
FILE = r"`(app/[\w/]*depths[\w/]*\.py)`(?:(?!```).)*```python\n(.*?)```"  # a name, and its text
pytestmark = one_window

WINDOW = """
import json
import sys
from pathlib import Path
import lucida
lucida.__path__.append(sys.argv[1])  # the renderer, whose kernels are compiled
from stepped import stepped
from lucida.app.window.platform import start_platform
from lucida.app.state.app_state import AppState
from lucida.app.window.viewer import WindowRun
from lucida.app.window.action_table import ACTIONS
from lucida.app.instruments.depths.view import Depths
from lucida.renderer.files import load_scene

state = AppState.for_scene(load_scene("still-life"))
run = WindowRun(start_platform(want_display=False), state, (900, 600), remember=False)
window = run.window

def step():
    window.show("Depths")
    if window.is_visible("Depths") and window.settled:
        [action] = [action for action in ACTIONS if action in Depths.actions]
        action.run(window)
        window.check()
        counts = Depths.counts(window.renderers.ray_image.frame, 16)
        told = {"bars": window.options.depths.bars, "pixels": int(counts.sum())}
        Path("told.json").write_text(json.dumps(told))
        run.params.app_shall_exit = True

stepped(run, step)
"""


def added(path, after, line, name, module):
    """Add a line, and an import of its name, to a file of the copy."""
    text = path.read_text()
    assert text.count(after) == 1, (path, after)
    text = text.replace(after, after + line)
    first = "from __future__ import annotations\n"
    path.write_text(text.replace(first, f"{first}\nfrom {module} import {name}\n", 1))


def test_the_documents_instrument_opens_in_the_window(tmp_path):
    text = (ROOT / "docs" / "architecture.md").read_text()
    text = text[text.index("## Adding an instrument") :]
    files = re.findall(FILE, text, re.DOTALL)
    option, entry = re.search(r"```text\n(.*?\n)(.*?\n)```", text, re.DOTALL).groups()
    assert [Path(name).name for name, _ in files] == ["model.py", "depths.py", "view.py"]
    assert sum(code.count("\n") for _, code in files) + 2 <= MOST_LINES

    copy = tmp_path / "copy"
    shutil.copytree(ROOT / "app", copy / "app")
    (copy / "shaders").symlink_to(ROOT / "shaders")
    (copy / "lucida").mkdir()  # without links, as Git for Windows makes it
    shutil.copy(ROOT / "lucida" / "__init__.py", copy / "lucida")
    (copy / "app" / "instruments" / "depths").mkdir()
    for name, code in files:
        (copy / name).write_text(code)
    options = copy / "app" / "state" / "options" / "__init__.py"
    added(
        options,
        "    costs: CostOptions = field(default_factory=CostOptions)\n",
        option,
        "DepthsOptions",
        "lucida.app.state.options.depths",
    )
    added(
        copy / "app" / "window" / "instruments.py",
        "    CostsView,\n",
        entry,
        "Depths",
        "lucida.app.instruments.depths.view",
    )
    variables = environment(tmp_path) | {"PYTHONPATH": os.pathsep.join((str(copy), SUPPORT))}
    done = subprocess.run(
        [sys.executable, "-c", WINDOW, str(ROOT / "lucida")],
        cwd=tmp_path,
        env=variables,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    told = json.loads((tmp_path / "told.json").read_text())
    assert told["bars"] == 64
    assert told["pixels"] > 0
