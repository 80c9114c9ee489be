"""The cost plot, as an instrument of the window."""

from __future__ import annotations

from app.costs.panel import AGAINST
from app.costs.view import CostsView
from app.host.instrument import Instrument

SYNONYMS = {
    "Costs": "performance complexity time plot",
}

PAGES: dict[str, dict[str, object]] = {
    f"Costs against {against}": {"against": against} for against in AGAINST
}
INSTRUMENT = Instrument(lambda views: [CostsView()], synonyms=SYNONYMS, pages=PAGES)
