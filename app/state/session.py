"""A session as the text of its file, and back.

The file's format is versioned JSON of the state and of the arrangement of the windows.
session_store.py finds its place. Options that an older session lacks have their defaults.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import msgspec

from lucida.renderer.files import BUILTIN_SCENES
from lucida.renderer.files.tables import check_integers
from lucida.renderer.scene import Scene, View
from lucida.renderer.system.errors import LucidaError

from .app_state import AppState
from .bounds import check
from .kept_lecture import KeptLecture
from .kept_scene import text_of_older, unsaved_text
from .options import Options
from .paths import restored, stored
from .removed import without_removed

VERSION = 1  # of the format: the key `lucida_session`
LARGEST_BYTES = 20 << 20  # it may contain an edited scene
OLDER = "The last session is of an earlier version:"


class NewerVersionError(LucidaError):
    """The file was written by a newer Lucida."""


@dataclass(frozen=True)
class Arrangement:
    """The arrangement of the windows inside the window.

    layout: its name. visible: the names of the shown views. sections: the unfolded parts of a
    view, by the view's name. focused: the name of the view that has the keyboard, or "".
    """

    layout: str = ""
    visible: tuple[str, ...] = ()
    sections: dict[str, tuple[str, ...]] = field(default_factory=dict)
    focused: str = ""


@dataclass(frozen=True)
class Session:
    """A session file.

    scene: an argument of load_scene, as paths.stored() writes it. lecture: the open one, or None.
    unsaved: the text of a scene file with unsaved changes, or "". notes: messages for the user,
    which are not written to the file. The other fields are those of AppState.
    """

    scene: str
    view: View
    keep_orthonormal: bool = True
    options: Options = field(default_factory=Options)
    arrangement: Arrangement = field(default_factory=Arrangement)
    lecture: KeptLecture | None = None
    unsaved: str = ""
    notes: tuple[str, ...] = ()

    @property
    def source(self) -> str:
        """The argument of load_scene."""
        return restored(self.scene)

    def state(self, scene: Scene) -> AppState:
        """Return the saved state, in the scene that was loaded for it."""
        return AppState(scene, self.view, self.keep_orthonormal, self.options)


def session_of(
    state: AppState, arrangement: Arrangement, lecture: KeptLecture | None = None
) -> Session:
    """Return a state's session. A scene from no file is replaced by the first built-in one."""
    source = stored(source_of(state.scene))
    unsaved = "" if state.step is not None else unsaved_text(state.scene)  # a step's is never saved
    return Session(
        source, state.view, state.keep_orthonormal, state.options, arrangement, lecture, unsaved
    )


def source_of(scene: Scene) -> str:
    """Return a scene's argument of load_scene: the first built-in scene's if it has no file."""
    origin = scene.origin
    return origin.source if origin is not None and origin.source else BUILTIN_SCENES[0]


def to_bytes(session: Session) -> bytes:
    """Return the file's content: JSON, indented for human readers."""
    table = {"lucida_session": VERSION, **msgspec.to_builtins(session)}
    del table["notes"]
    return msgspec.json.format(msgspec.json.encode(table), indent=1) + b"\n"


def from_bytes(data: bytes, source: str = "") -> Session:
    """Return the session in a file. Raises LucidaError, NewerVersionError for a newer file."""
    try:
        return _session(data)
    except LucidaError as error:
        error.source = error.source or source
        raise


def _session(data: bytes) -> Session:
    remedy = "Lucida starts afresh"
    if len(data) > LARGEST_BYTES:
        raise LucidaError("", f"holds {len(data)} bytes, more than a session has", remedy)
    try:
        table = msgspec.json.decode(data)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError, ValueError) as error:
        raise LucidaError("", f"is not a session: {error}", remedy) from None
    check_integers(table, remedy)
    version = table.pop("lucida_session", None) if isinstance(table, dict) else None
    if isinstance(version, bool) or not isinstance(version, int) or version < 1:
        raise LucidaError("lucida_session", "is missing: this is not a session", remedy)
    if version > VERSION:
        raise NewerVersionError(
            "lucida_session",
            f"the session is of version {version}, this program reads up to {VERSION}",
            "update Lucida to go on with it",
        )
    options = table.get("options")
    notes: list[str] = []
    if isinstance(options, dict):
        table["options"], removed = without_removed(options)
        if removed:
            notes = [f"{OLDER} {len(removed)} of its settings were removed (CHANGELOG.md)."]
    table.pop("notes", None)
    if edited := table.pop("edited", None):  # of an earlier version
        table["unsaved"] = text_of_older(edited)
    try:
        session = msgspec.convert(table, Session)
        check(Session, session)
    except LucidaError as error:
        raise LucidaError(error.field, error.problem, remedy) from None
    except (msgspec.ValidationError, RecursionError) as error:
        raise LucidaError("", f"is damaged: {error}", remedy) from None
    return replace(session, notes=tuple(notes))
