"""The cost plot, as an instrument of the window."""

from __future__ import annotations

from app.costs.view import CostsView
from app.host.instrument import Instrument

SYNONYMS = {
    "Costs": "performance complexity time plot",
}

INSTRUMENT = Instrument(lambda views: [CostsView()], synonyms=SYNONYMS)
