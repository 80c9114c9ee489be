"""Every step of the built-in lecture is opened: its own state, its views, no error."""

from __future__ import annotations

import itertools

import numpy as np
from window_driver import Driver, Key

from app.lecture.reading import BUILTIN, load_lecture
from app.lecture.step_options import state_of
from app.lecture.view import LECTURE


def drive_every_step_shows_its_own_state(d: Driver) -> None:
    lecture = load_lecture(BUILTIN)
    d.window.lecture.give(lecture, BUILTIN)
    pictures = []
    for number, step in enumerate(lecture.steps):
        d.settle()
        session = d.window.lecture.session
        assert session is not None and session.number == number
        wanted = {name.capitalize() for name in step.views}
        shown = {view.name for view in d.window.shell.stage.shown}
        assert shown == {LECTURE, *wanted}, step.title
        assert d.window.renderers.failure is None and not d.window.files.message, step.title
        state = d.window.state.with_options(marked_size=None)  # of the image that is shown
        own = state_of(step, state)
        assert state.options.stepper == own.options.stepper, step.title
        assert state.options == own.options, step.title
        assert state == own, step.title
        pictures.append(d.picture())
        for name in wanted:  # something is to be seen in each view
            left, top, right, bottom = (round(x) for x in d.window.shell.stage.rects[name])
            part = pictures[-1][top:bottom, left:right]
            assert min(part.shape[:2]) > 80 and part.std() > 5, (step.title, name)
        d.ctx.key_press(int(Key.page_down))
    for one, next_one in itertools.pairwise(pictures):
        assert np.abs(one.astype(int) - next_one).max() > 30
