"""The action of films."""

from __future__ import annotations

from app.filming.view import FILM
from app.host import layout
from app.host.action import Action

FILMS = (
    Action("File", "Save film...", lambda window: window.shell.stage.show_in(FILM, layout.FILM)),
)
