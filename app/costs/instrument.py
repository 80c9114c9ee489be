"""The cost plot, as the window takes it."""

from __future__ import annotations

from app.costs.view import CostsView
from app.host.instrument import Instrument

SYNONYMS = {
    "Costs": "performance complexity time plot",
}

INSTRUMENT = Instrument(lambda views: [CostsView()], synonyms=SYNONYMS)
