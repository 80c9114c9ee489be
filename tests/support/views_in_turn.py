"""Every view of the window alone, one after another, with something to show."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import get_args, get_type_hints

from alone import show_only
from option_changes import with_options
from window_driver import Driver

from lucida.app.instruments.laboratory.view import LABORATORY
from lucida.app.state.app_state import AppState
from lucida.app.state.options.laboratory import LaboratoryOptions
from lucida.app.state.paths import stored

PAGES = get_args(get_type_hints(LaboratoryOptions)["page"])

CODE = """\
def viewing_ray(i, j, width, height, camera):
    x = camera.left + j / width * (camera.right - camera.left)
    y = camera.top - i / height * (camera.top - camera.bottom)
    d = camera.distance
    return camera.eye, [x * a + y * b - d * c for a, b, c in zip(camera.u, camera.v, camera.w)]
"""


def with_content(d: Driver) -> AppState:
    """Return a state in which the views have something to show."""
    code = d.folder / "rays.py"
    code.write_text(CODE)
    return with_options(
        d.state,
        marked=(60, 80),
        objects={"chosen": (2,)},
        probe={"pins": ((10, 20), (300, 400))},
        your_code={"file": stored(str(code))},
    )


def views_in_turn(d: Driver, pages: Sequence[str] = PAGES) -> Iterator[str]:
    """Show every view alone, and the laboratory's pages."""
    stage = d.stage
    before = {view.name for view in stage.shown}
    for name in stage.views:
        show_only(d, [name])
        for page in pages if name == LABORATORY else ("",):
            if page:
                d.change(laboratory={"page": page})
            d.frames()
            d.until(lambda name=name: name in stage.rects and stage.views[name].settled)
            d.frames(3)
            yield f"{name} {page}"
    show_only(d, before)
