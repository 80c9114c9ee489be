"""The cost plot's view, and the palette's entries for its two plots."""

from __future__ import annotations

from app.instruments.costs.recorded import COSTS
from app.instruments.costs.view import CostsView
from app.ui.instrument import Instrument

INSTRUMENT = Instrument(
    lambda views: [CostsView()],
    synonyms={"Costs": "performance complexity time plot"},
    pages={f"Costs against {unit}": {"against": unit} for unit in COSTS},
)
