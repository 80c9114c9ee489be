"""The pixel probe, as an instrument of the window."""

from __future__ import annotations

from app.host.instrument import Instrument
from app.host.view import view_of
from app.outside.view import OutsideView
from app.pair.view import RasterView
from app.probe.actions import PINNING
from app.probe.view import ProbeView

SYNONYMS = {
    "Probe": "ray formula intersection pixel",
}

INSTRUMENT = Instrument(
    lambda views: [ProbeView(view_of(views, OutsideView), view_of(views, RasterView).linked)],
    PINNING,
    keyboard=(("arrows in the probe", "another pixel; Shift: by ten"),),
    synonyms=SYNONYMS,
)
