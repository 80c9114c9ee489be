"""What the tracer uses of numba's inside, and how it does without."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from renderer.scene import load_scene
from renderer.trace import Tracer
from renderer.trace.compile import numba_compiler, numba_inside

SIZE = (48, 32)
SCRIPT = """
import sys
import numpy as np
from renderer.scene import load_scene
from renderer.trace import Tracer
from renderer.trace.compile import numba_inside
scene = load_scene("still-life")
size = (48, 32)
with Tracer(scene) as tracer:
    frame = tracer.render(scene.view.for_size(size), size)
np.savez(sys.argv[1], color=frame.color, depth=frame.depth, id=frame.id)
print(*numba_inside.missing())
"""


def test_this_numba_has_all_that_is_used_of_its_inside() -> None:
    assert numba_inside.missing() == ()


@pytest.mark.timeout(600)
def test_without_numbas_inside_a_scene_is_the_same_picture(tmp_path: Path) -> None:
    """In a cache of its own: kernels are compiled, then found there."""
    environment = os.environ | {"LUCIDA_NUMBA": "plain", "NUMBA_CACHE_DIR": str(tmp_path)}
    for file in (tmp_path / "compiled.npz", tmp_path / "kept.npz"):
        done = subprocess.run(
            [sys.executable, "-c", SCRIPT, str(file)],
            env=environment, capture_output=True, text=True,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        assert done.stdout.split() == list(numba_inside.PARTS)
    scene = load_scene("still-life")
    with Tracer(scene) as tracer:
        frame = tracer.render(scene.view.for_size(SIZE), SIZE)
    with np.load(tmp_path / "kept.npz") as plain:
        for channel in ("color", "depth", "id"):
            np.testing.assert_array_equal(plain[channel], frame.channel(channel))


@pytest.mark.parametrize(
    "needs",
    [
        ((numba_compiler.Compiler, ("define_pipelines", "gone")),),
        ((numba_compiler.JITCodeLibrary, ("gone",)), (numba_compiler.Compiler, ("state",))),
    ],
)
def test_a_part_that_lacks_something_is_done_without(monkeypatch, needs) -> None:
    monkeypatch.setattr(numba_compiler, "NEEDS", needs)
    assert numba_inside.part.__wrapped__("numba_compiler") is None
    monkeypatch.setattr(numba_compiler, "NEEDS", ((numba_compiler.Compiler, ("state",)),))
    assert numba_inside.part.__wrapped__("numba_compiler") is numba_compiler  # set by __init__


def test_a_part_whose_modules_are_gone_is_done_without(monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, f"{numba_compiler.__package__}.numba_cache", None)
    assert numba_inside.part.__wrapped__("numba_cache") is None
