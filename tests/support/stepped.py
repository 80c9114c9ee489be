"""A real window in a process of its own, which the script of a test steps frame by frame."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from glimpses import skip_unseen
from option_changes import with_options

from lucida.app.window import viewer
from lucida.app.window.platform import start_platform
from lucida.app.window.start import begin_session
from lucida.app.window.viewer import WindowRun

WAIT_S = 0.03


def stepped(run: WindowRun, step: Callable[[], None]) -> None:
    """Run the window, and call step() in each frame.

    After it, wait for news from a thread: frames at full speed would take the processor from it.
    """

    def each():
        step()
        run.window.news.wait(WAIT_S)
        run.window.news.clear()

    skip_unseen(run)
    run.params.callbacks.post_new_frame = each
    run.params.fps_idling.enable_idling = False
    run.run()


def session_window(folder: Path, options: dict[str, Any] | None = None, **given: Any) -> WindowRun:
    """Return a window that goes on with the session in a folder, and keeps it there.

    options: of the state. given: other parts of Start.
    """
    viewer.settings_file = lambda fresh=False: folder / "window.ini"
    viewer.user_folder = lambda: folder
    start = replace(begin_session(folder=folder), **given)
    start = replace(start, state=with_options(start.state, **(options or {})))
    return WindowRun(start_platform(want_display=False), start.state, (900, 600), start=start)
