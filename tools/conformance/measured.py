"""The distance between two programs' pixels, and its bound; the input and the result of a format's
check.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import ModuleType

import numpy as np
from numpy.typing import ArrayLike

EXACT_PX = 1e-6  # for programs that compute in float64


class PeerMissing(Exception):  # noqa: N818 # nothing is wrong
    """The real program is not there: why."""


@dataclass(frozen=True)
class Job:
    """cameras: how many to check, at least. seed: of what is random. folder: an empty one, for
    files. home: the environment's."""

    cameras: int
    seed: int
    folder: Path
    home: Path

    @property
    def random(self) -> np.random.Generator:
        return np.random.default_rng(self.seed)


@dataclass(frozen=True)
class Measured:
    """worst: the largest error; bound: what was allowed there. share: the largest part that an
    error was of its own bound. unit: "px", or what else was compared. beside: whether it is told
    beside the table of pixels."""

    what: str
    cameras: int
    worst: float
    bound: float
    share: float
    unit: str = "px"
    beside: bool = False

    @property
    def met(self) -> bool:
        """False for NaN too."""
        return self.share <= 1


@dataclass(frozen=True)
class Checked:
    """peer: name and version of what the format was held against."""

    peer: str
    measured: tuple[Measured, ...]


def measured(
    what: str,
    errors: ArrayLike,
    bounds: ArrayLike = EXACT_PX,
    *,
    cameras: int | None = None,
    unit: str = "px",
    beside: bool = False,
) -> Measured:
    """Return the worst of the errors and the bound there. Without errors nothing is met.

    errors, bounds: of the same shape, or one bound for all. cameras: their number, unless each has
    one error.
    """
    cameras = len(np.asarray(errors)) if cameras is None else cameras
    beside = beside or unit != "px"
    found, allowed = (
        np.ravel(part) for part in np.broadcast_arrays(np.abs(np.asarray(errors, float)), bounds)
    )
    if not found.size or not np.isfinite(found).all():
        return Measured(what, cameras, math.nan, math.nan, math.nan, unit, beside)
    with np.errstate(all="ignore"):
        shares = np.where(found == 0, 0.0, found / allowed)
    at = int(found.argmax())
    worst, bound = float(found[at]), float(allowed[at])
    return Measured(what, cameras, worst, bound, float(shares.max()), unit, beside)


def needed(module: str) -> ModuleType:
    """Raises PeerMissing where it cannot be imported; what else fails there is a fault."""
    try:
        return import_module(module)
    except ImportError as error:  # also of the system's libraries that it needs
        raise PeerMissing(str(error).split("\n")[0]) from None
