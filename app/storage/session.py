"""What was open, as the text of a session file, and back.

Owns the file's format: versioned JSON of the state and of the arrangement of the windows. Knows
nothing of where the file lies (session_store.py), nor of windows. Options that a session does not
hold, because it is older, have their defaults.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import msgspec

from app.state.all_options import AllOptions
from app.state.app_state import AppState
from app.state.bounds import check
from app.storage.kept_lecture import KeptLecture
from app.storage.kept_scene import KeptScene, kept_scene
from app.storage.paths import restored, stored
from renderer.errors import LucidaError
from renderer.scene import BUILTIN_SCENES, Scene, View, load_scene
from renderer.scene.tables import check_integers

VERSION = 1  # of the format: the key `lucida_session`
LARGEST_BYTES = 20 << 20  # an edited scene is in it twice, as it is and as its file is


class NewerVersionError(LucidaError):
    """The file was written by a newer Lucida."""


@dataclass(frozen=True)
class Arrangement:
    """Where the windows inside the window are. layout: its name. visible: the names of the views
    that are shown. windows: places and docks, as ImGui writes them. sections: which parts of a view
    are folded open, by the view's name, where the user has chosen. maximised: the name of the view
    that covers all others, focused: of the one that has the keyboard, or "". parts: what docks take
    of the room that they share, by layout and space."""

    layout: str = ""
    visible: tuple[str, ...] = ()
    windows: str = ""
    sections: dict[str, tuple[str, ...]] = field(default_factory=dict)
    maximised: str = ""
    focused: str = ""
    parts: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Session:
    """A session file. scene: what load_scene takes, as paths.stored() writes it. lecture: the one
    that was given, or None. edited: the scene, where it is not what load_scene gives. The rest as
    in AppState."""

    scene: str
    view: View
    keep_orthonormal: bool = True
    options: AllOptions = field(default_factory=AllOptions)
    arrangement: Arrangement = field(default_factory=Arrangement)
    lecture: KeptLecture | None = None
    edited: KeptScene | None = None

    @property
    def source(self) -> str:
        """What load_scene takes."""
        return restored(self.scene)

    def load_scene(self) -> Scene:
        """The scene as it was left. Raises LucidaError."""
        return load_scene(self.source) if self.edited is None else self.edited.scene()

    def state(self, scene: Scene) -> AppState:
        """The state that was kept, in the scene that was loaded for it."""
        return AppState(scene, self.view, self.keep_orthonormal, self.options)


def session_of(
    state: AppState, arrangement: Arrangement, lecture: KeptLecture | None = None
) -> Session:
    """What to keep of a state. A scene from no file is not kept: the first built-in one is."""
    source, edited = stored(source_of(state.scene)), kept_scene(state.scene)
    return Session(
        source, state.view, state.keep_orthonormal, state.options, arrangement, lecture, edited
    )


def source_of(scene: Scene) -> str:
    """What load_scene takes for a scene; the first built-in one's name for one from no file."""
    origin = scene.origin
    return origin.source if origin is not None and origin.source else BUILTIN_SCENES[0]


def to_bytes(session: Session) -> bytes:
    """The file's content: JSON, indented, for whoever looks into it."""
    table = {"lucida_session": VERSION, **msgspec.to_builtins(session)}
    return msgspec.json.format(msgspec.json.encode(table), indent=1) + b"\n"


def from_bytes(data: bytes, source: str = "") -> Session:
    """The session in a file. Raises LucidaError, NewerVersionError for a newer file."""
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
        raise LucidaError("", f"is no session: {error}", remedy) from None
    check_integers(table, remedy)
    version = table.pop("lucida_session", None) if isinstance(table, dict) else None
    if isinstance(version, bool) or not isinstance(version, int) or version < 1:
        raise LucidaError("lucida_session", "is missing: this is no session", remedy)
    if version > VERSION:
        raise NewerVersionError(
            "lucida_session",
            f"the session is of version {version}, this program reads up to {VERSION}",
            "update Lucida to go on with it",
        )
    try:
        session = msgspec.convert(table, Session)
        check(Session, session)
    except LucidaError as error:
        raise LucidaError(error.field, error.problem, remedy) from None
    except (msgspec.ValidationError, RecursionError) as error:
        raise LucidaError("", f"is damaged: {error}", remedy) from None
    return session
