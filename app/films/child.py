"""The main function of a process that makes a film for another one, and reports in lines of JSON:
{"part": 0.25}, and at last {"error": ...} if it failed.
"""

from __future__ import annotations

import json
import pickle
from pathlib import Path

from app.films.film import begin, make
from app.films.order import Order
from renderer.child import end_with_parent
from renderer.errors import describe


def main(file: str) -> None:
    """Make the film of a pickled Order, and delete the file."""
    end_with_parent()
    order: Order = pickle.loads(Path(file).read_bytes())
    Path(file).unlink()
    try:
        film = order.film()
        _say(part=begin(film) / order.count)
        make(film, progress=lambda part: _say(part=part))
    except Exception as error:
        _say(error=describe(error))


def _say(**report: float | str) -> None:
    print(json.dumps(report), flush=True)
