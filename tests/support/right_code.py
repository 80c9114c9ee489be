"""The answer of a correct viewing_ray, from the values that it is given."""

from __future__ import annotations

from typing import Any

import numpy as np


def right_ray(known: dict[str, Any]) -> list[list[float]]:
    """Origin and a direction three times as long as the formula's, in perspective."""
    camera = known["camera"]
    x = camera["left"] + (known["j"] + 0.5) / known["width"] * (camera["right"] - camera["left"])
    y = camera["top"] - (known["i"] + 0.5) / known["height"] * (camera["top"] - camera["bottom"])
    u, v, w, eye = (np.array(camera[name]) for name in ("u", "v", "w", "eye"))
    if camera["projection"] == "parallel":
        return [(eye + x * u + y * v).tolist(), (-w).tolist()]
    return [eye.tolist(), (3 * (x * u + y * v - camera["distance"] * w)).tolist()]
