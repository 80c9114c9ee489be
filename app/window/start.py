"""The window's initial content: a scene from the command line, a lecture, the last session, or the
default scene.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from imgui_bundle import hello_imgui

from lucida.app.instruments.poses.model import PoseSet
from lucida.app.lecture.model import Lecture
from lucida.app.lecture.session import LectureSession
from lucida.app.lecture.step_options import own, state_of
from lucida.app.state.app_state import AppState
from lucida.app.state.kept_lecture import KeptLecture
from lucida.app.state.options import Options
from lucida.app.state.session import Session
from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.scene import View
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError

from .capture import free_path
from .session_store import Keeper, SessionFile, take_place

ChangeView = Callable[[View], View]
UNKEPT = "This session will not be kept: the settings folder cannot be written to."


@dataclass(frozen=True)
class Start:
    """The window's initial content.

    session: the session to continue, or None. keeper: saves it. message: a message for the user.
    opened: a scene for the recent files. lecture: the lecture to continue. fresh: True to ignore
    the layout of earlier windows. left: the last session's lecture. code: the absolute path of a
    student's Python file to run. poses: a set of cameras to show. unsaved: a scene file with the
    last session's unsaved changes.
    """

    state: AppState
    session: Session | None = None
    keeper: Keeper | None = None
    message: str = ""
    opened: str = ""
    lecture: LectureSession | None = None
    left: KeptLecture | None = None
    fresh: bool = False
    code: str = ""
    poses: PoseSet | None = None
    unsaved: Path | None = None


def begin_scene(
    source: str | None = None,
    view: View | None = None,
    change: ChangeView | None = None,
) -> Start:
    """Begin with a scene, the default one if none is given.

    view: used in place of the scene's own. change: applied to the view. Raises LucidaError.
    """
    scene = load_scene(source or BUILTIN_SCENES[0])
    view = view or scene.view
    view = view if change is None else change(view)
    return Start(AppState.for_scene(scene, view), opened=source or "")


def begin_session(fresh: bool = False, folder: Path | None = None) -> Start:
    """Continue the last session, or begin an empty one. fresh: True to ignore the last one.

    folder: the folder of sessions; None for the user's settings folder. A scene that is missing or
    cannot be read is reported; the rest of the session is kept.
    """
    if fresh:
        return replace(_in_place(begin_scene(), folder)[1], fresh=True)
    place = take_place(folder)
    if place is None:
        return replace(begin_scene(), message=UNKEPT)
    keeper = Keeper(place, hello_imgui.request_refresh)
    session, told = place.load()
    if session is None:
        return replace(begin_scene(), keeper=keeper, message=told)
    lecture, message = _lecture(session.lecture)
    start = _gone_on(session, lecture)
    both = "\n".join(said for said in (told, message, start.message) if said)
    unsaved = _rescued(session, place)
    return replace(start, keeper=keeper, lecture=lecture, message=both, unsaved=unsaved)


def kept(start: Start, fresh: bool = False, folder: Path | None = None) -> Start:
    """Replace the session by one with the scene that the command line named.

    The user's own settings of the last session are kept, except for presentation mode; the rest is
    dropped. fresh, folder: as in begin_session().
    """
    options, start = _in_place(start, folder)
    state = replace(start.state, options=own(Options() if fresh else options))
    state = state.with_options(replace(state.options.preferences, presentation=False))
    return replace(start, state=state, fresh=fresh)


def begin_lecture(
    lecture: Lecture, at: tuple[int, int] = (0, 0), folder: Path | None = None
) -> Start:
    """Begin a lecture at a build of a step, and save it as the session.

    The user's own settings of the last session are kept; the rest is dropped, as when another scene
    is opened.
    """
    options, start = _in_place(Start(first_state(lecture)), folder)
    return replace(start, state=first_state(lecture, at, options))


def _in_place(start: Start, folder: Path | None) -> tuple[Options, Start]:
    """Replace the last session by a start.

    Return the last session's options, and the start with a message for the user. Unsaved changes
    are rescued.
    """
    place = take_place(folder)
    if place is None:
        return Options(), replace(start, message=UNKEPT)
    session, told = place.load()
    start = replace(start, keeper=Keeper(place, hello_imgui.request_refresh), message=told)
    if session is None:
        return Options(), start
    return session.options, replace(start, left=session.lecture, unsaved=_rescued(session, place))


def _rescued(session: Session, place: SessionFile) -> Path | None:
    """Keep the unsaved changes of a session in a scene file, or set the session aside. Return the
    file; None if there are no changes, or nothing can be written.
    """
    if not session.unsaved:
        return None
    path = free_path(place.path.with_name("unsaved.toml"))
    try:
        with atomic_write(path) as file:
            file.write(session.unsaved.encode())
    except LucidaError:
        return place.put_aside("unsaved")
    return path


def first_state(
    lecture: Lecture, at: tuple[int, int] = (0, 0), options: Options | None = None
) -> AppState:
    """Return the state that a lecture begins with, for the last row.

    at: the step and its build. options: the user's options.
    """
    step = lecture.builds[lecture.place(*at)]
    seen = replace(
        AppState.for_scene(step.scene, step.view),
        options=options or Options(),
        step=(lecture.source, step.number, step.build),
    )
    seen = seen.with_options(
        replace(seen.options.preferences, presentation=True, reduced_motion=False)
    )
    return state_of(step, seen)


def _lecture(kept: KeptLecture | None) -> tuple[LectureSession | None, str]:
    """Return the lecture of a session, and a message for the user."""
    if kept is None:
        return None, ""
    try:
        lecture = LectureSession.resumed(kept)
    except LucidaError as error:
        again = "Its step and the answers are kept: they come back with the file."
        return None, f"The last session's lecture could not be opened. {error}. {again}"
    if not lecture.differs_from(kept) or not kept.file:
        return lecture, ""
    restore = "Backspace shows its step as it is now." if kept.in_step else ""
    return lecture, f"{lecture.lecture.source} has changed since the last session. {restore}"


def _gone_on(session: Session, lecture: LectureSession | None) -> Start:
    """Continue with the session's scene, or with the default scene if that cannot be read."""
    step = lecture if session.lecture is not None and session.lecture.in_step else None
    if step is not None:
        return Start(replace(session.state(step.step.scene), step=step.place), session)
    try:
        return Start(session.state(load_scene(session.source)), session)
    except LucidaError as error:
        message = f"The last session's scene could not be opened. {error}"
    default = load_scene(BUILTIN_SCENES[0])  # the session's camera may see nothing of it
    state = replace(session.state(default), view=default.view)
    return Start(state, session, message=message)
