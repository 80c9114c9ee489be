"""Films, as an instrument of the window."""

from __future__ import annotations

from app.filming.view import FilmView
from app.host.instrument import Instrument
from app.host.view import view_of
from app.outside.view import OutsideView
from app.poses.view import PosesView

SYNONYMS = {
    "Film": "animation video movie mp4 gif orbit turntable dolly path",
    "Save film...": "animation video movie mp4 gif record orbit turntable dolly vertigo",
}

INSTRUMENT = Instrument(
    lambda views: [FilmView(view_of(views, OutsideView), view_of(views, PosesView))],
    synonyms=SYNONYMS,
)
