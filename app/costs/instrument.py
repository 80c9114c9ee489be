"""The cost plot, as the window takes it."""

from __future__ import annotations

from app.costs.view import CostsView
from app.host.instrument import Instrument

INSTRUMENT = Instrument(lambda views: [CostsView()])
