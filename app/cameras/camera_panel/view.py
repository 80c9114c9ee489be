"""The camera's panel as a view.

It keeps the draft of invalid numbers. camera_panel/panel.py draws the panel.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lucida.app.cameras.editing import Draft
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument
from lucida.app.ui.layout import INSTRUMENTS

from .actions import CAMERA as ACTIONS
from .actions import EDIT, image_size
from .panel import PanelOutcome, camera_panel
from .projection import PanelContext
from .sections import Sections

CAMERA = "Camera"


class CameraView(Instrument):
    """The camera's panel.

    draft: numbers that do not make a valid camera yet.
    entered: the contents of the sections.
    """

    name = CAMERA
    title = "Camera"
    space = INSTRUMENTS
    actions = (*EDIT, *ACTIONS)

    def __init__(self, views: Sequence[Instrument] = ()) -> None:
        self.draft: Draft | None = None
        self.entered = Sections()

    @property
    def sections(self) -> tuple[str, ...]:
        return self.entered.opened

    def open_sections(self, names: tuple[str, ...]) -> None:
        self.entered = replace(self.entered, opened=names)

    @property
    def has_pending(self) -> bool:
        return self.draft is not None and self.draft.error is not None

    def drop_pending(self) -> None:
        self.draft = None

    def draw(self, host: Host) -> None:
        state = host.state
        shown = host.renderers.camera(state)
        size = image_size(host)
        around = PanelContext(host.fonts, shown, size, host.focus)
        panel = PanelOutcome(self.draft or Draft.of(state.camera), self.entered)
        state, panel = camera_panel(state, panel, around)
        self.draft, self.entered = panel.draft, panel.sections
        host.apply(state)
        if panel.wish is not None:
            panel.wish.run(host)
