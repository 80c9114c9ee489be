"""The lecture in the window: for several topics of drives."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps

from window_driver import Driver

from lucida.app.lecture.model import Lecture
from lucida.app.lecture.reading import load_lecture
from lucida.app.lecture.view import LECTURE, LectureView

SMALL = """\
title = "Small"
[[steps]]
title = "First"
text = "One **ball** at $z = -3$."
scene = "spheres"
[[steps]]
title = "Second"
views = ["ray"]
scene = "canonical"
options.images.exposure_ev = 1.0
"""


def lecture_of(d: Driver) -> LectureView:
    return d.window.lecture


def give(d: Driver, text: str = SMALL) -> Lecture:
    """Begin a lecture of this text."""
    path = d.folder / "small.toml"
    path.write_text(text)
    lecture = load_lecture(path)
    lecture_of(d).give(lecture, path)
    d.settle()
    return lecture


@contextmanager
def untraced(d: Driver) -> Iterator[None]:
    """Trace no image, and wait for none: nobody looks at it."""
    live = d.renderers.live

    def rest() -> None:
        d.frames(2)
        window = d.window
        d.until(lambda: d.stage.settled and not (window.files.busy or window.motions.under_way))
        assert not d.stage.failed.errors
        d.frames()

    live.request, d.settle = (lambda *_: None), rest  # type: ignore[method-assign]
    try:
        yield
    finally:
        del live.request, d.settle


def untraced_drive(drive: Callable[[Driver], None]) -> Callable[[Driver], None]:
    """Decorate a drive in which nobody looks at a traced image."""

    @wraps(drive)
    def untraced_throughout(d: Driver) -> None:
        with untraced(d):
            drive(d)

    return untraced_throughout


def shown(d: Driver) -> set[str]:
    """Return the names of the views that are shown."""
    return {view.name for view in d.stage.shown}


def number_of(d: Driver) -> int:
    """Return the number of the present step."""
    session = lecture_of(d).session
    return session.number


def item(d: Driver, name: str) -> str:
    """Return the path of an item of the step's text, which scrolls in a window of its own."""
    return f"//{LECTURE}/**/{name}"


def answer(d: Driver, field: str, text: str) -> None:
    """Type an answer into a field of the exercise."""
    d.ctx.item_input_value(item(d, f"##{field}"), text)
    d.frames(2)
