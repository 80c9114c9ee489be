"""A start that makes dataclasses' methods later: they are the same, and made once."""

from __future__ import annotations

import dataclasses
import gc
import os
import pickle
import subprocess
import sys
from typing import Any

import pytest

from app.window import quick_start

CREATE = "_create_fn"
made: list[str] = []


@pytest.fixture
def lazy(monkeypatch: pytest.MonkeyPatch) -> None:
    """Dataclasses as the process that begins quickly has them; made: the methods that there are."""
    create = getattr(dataclasses, CREATE, None)
    if create is None:
        pytest.skip("this version of Python makes all methods of a class at once")

    def noted(name: str, *arguments: Any, **options: Any) -> Any:
        made.append(name)
        return create(name, *arguments, **options)

    made.clear()
    monkeypatch.setattr(dataclasses, CREATE, quick_start.lazily(noted))


def test_methods_are_made_when_they_are_called_and_then_no_more(lazy: None) -> None:
    @dataclasses.dataclass(frozen=True)
    class Point:
        x: float
        y: float = 2.0

    assert made == []
    assert Point(1.0) == Point(1.0, 2.0) != Point(y=1.0, x=1.0)
    assert made == ["__init__", "__eq__"]
    assert "x=1.0, y=2.0" in repr(Point(1.0)) and "x=3" in repr(Point(3))
    assert hash(Point(1.0)) == hash(Point(1.0)) and len({Point(1), Point(1)}) == 1
    assert dataclasses.replace(Point(1.0), y=5.0) == Point(1.0, 5.0)
    with pytest.raises(dataclasses.FrozenInstanceError, match="cannot assign to field 'x'"):
        Point(1.0).x = 2.0  # type: ignore[misc]
    with pytest.raises(dataclasses.FrozenInstanceError, match="cannot delete field 'y'"):
        del Point(1.0).y  # type: ignore[misc]
    with pytest.raises(TypeError, match=r"Point.__init__\(\) missing 1 required .* 'x'"):
        Point()  # type: ignore[call-arg]
    assert sorted(made) == sorted(set(made))
    assert Point.__init__.__code__.co_filename == "<string>"  # the class has the real one


def test_classes_that_inherit_and_slots_and_order(lazy: None) -> None:
    @dataclasses.dataclass
    class Base:
        self: int  # a name that a method's own must not clash with

        def __post_init__(self) -> None:
            object.__setattr__(self, "seen", True)

    @dataclasses.dataclass(order=True)
    class Derived(Base):
        more: list[int] = dataclasses.field(default_factory=list)

    assert Derived(self=1, more=[2]) == Derived(1, [2]) and Derived(1) < Derived(2)
    assert Base(self=4).self == 4 and Derived(1).more is not Derived(1).more
    assert Derived(1).seen and Base(2).seen  # type: ignore[attr-defined]

    @dataclasses.dataclass(slots=True)
    class Narrow:
        x: int

    assert Narrow(1) == Narrow(1) and not hasattr(Narrow(1), "__dict__")


def test_a_process_that_begins_quickly_is_the_same_to_others() -> None:
    code = (
        "from app.window import quick_start; quick_start.begin(); import gc, pickle, sys;"
        "from renderer.camera import Camera; import numpy;"
        "assert gc.get_threshold()[0] == quick_start.YOUNG_OBJECTS;"
        "sys.stdout.buffer.write(pickle.dumps(Camera(eye=(1.0, 2.0, 3.0))))"
    )
    without = {k: v for k, v in os.environ.items() if k != "OPENBLAS_NUM_THREADS"}
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, check=True, env=without
    )
    from renderer.camera import Camera

    assert pickle.loads(done.stdout) == Camera(eye=(1.0, 2.0, 3.0))


def test_what_the_user_says_about_threads_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dataclasses, CREATE, getattr(dataclasses, CREATE, None), raising=False)
    before = gc.get_threshold()
    try:
        monkeypatch.setenv("OPENBLAS_NUM_THREADS", "3")
        quick_start.begin()
        assert os.environ["OPENBLAS_NUM_THREADS"] == "3"
        monkeypatch.delenv("OPENBLAS_NUM_THREADS")
        quick_start.begin()
        assert os.environ["OPENBLAS_NUM_THREADS"] == "1"
    finally:
        gc.set_threshold(*before)


def python(code: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)


def test_nothing_is_collected_while_much_is_imported() -> None:
    code = (
        "from app.window.quick_start import without_garbage; import contextlib, gc\n"
        "with contextlib.suppress(ImportError), without_garbage():\n"
        "    assert not gc.isenabled()\n"
        "    raise ImportError\n"
        "print(gc.isenabled(), gc.get_freeze_count() > len(gc.get_objects()))\n"
    )
    assert python(code).stdout == "True True\n"


def test_the_end_keeps_the_status_and_does_what_was_asked_for() -> None:
    done = python(
        "import atexit, sys, tempfile, threading, time; from app.window import quick_start\n"
        "class Late:\n"
        "    def __del__(self): print('let go')\n"
        "late = Late()\n"
        "folder = tempfile.TemporaryDirectory()\n"
        "atexit.register(print, 'at exit')\n"
        "threading.Thread(target=lambda: (time.sleep(0.1), print('thread'))).start()\n"
        "threading.Thread(target=time.sleep, args=(1000,), daemon=True).start()\n"
        "print(folder.name)\n"
        "print('error', end='', file=sys.stderr)\n"
        "quick_start.end(7)\n"
    )
    folder, *told = done.stdout.splitlines()
    assert (told, done.returncode) == (["thread", "at exit"], 7)
    assert done.stderr.startswith("error")
    assert not os.path.exists(folder)


def test_the_end_minds_no_closed_output() -> None:
    done = python("from app.window import quick_start; import sys; print(1); sys.stdout.close();"
                  "sys.stderr = None; quick_start.end(3)")  # fmt: skip
    assert done.returncode == 3
