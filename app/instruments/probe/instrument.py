"""The pixel probe, as an instrument of the window."""

from __future__ import annotations

from app.images.pair.view import RasterView
from app.instruments.outside.view import OutsideView
from app.instruments.probe.actions import PINNING
from app.instruments.probe.view import ProbeView
from app.ui.instrument import Instrument
from app.ui.view import view_of

SYNONYMS = {
    "Probe": "ray formula intersection pixel",
}

INSTRUMENT = Instrument(
    lambda views: [ProbeView(view_of(views, OutsideView), view_of(views, RasterView).linked)],
    PINNING,
    keyboard=(("arrows in the probe", "another pixel; Shift: by ten"),),
    synonyms=SYNONYMS,
)
