"""Blinn and Phong's highlight as a measured material, which Mitsuba reads as a table.

No lobe of Mitsuba's own is as bright: microfacet models conserve energy, and their highlight fades
with the light's cosine, which (n . h)^shininess does not.
Source: Dupuy and Jakob 2018, "An adaptive parameterization for efficient material acquisition and
rendering", and the layout of their tensor files.
"""

from __future__ import annotations

import math
import struct

import numpy as np
from numpy.typing import NDArray

from renderer.scene.model import Color

ANGLES = 512  # from the normal to the horizon, densest at the normal
BYTE, FLOAT = 1, 10  # types in a tensor file


def lobe_bytes(specular: Color, shininess: float, weight: float) -> bytes:
    """Return a measured material with the value specular * (n . h)^shininess / (pi * weight) for
    light of irradiance 1, at any angle of the light.

    weight: of the material in a blend.
    """
    # The table is a distribution of normals times a colour over 4 times the projected area, here 1.
    # Its coordinate is the square root of the angle between n and h, relative to 90 degrees.
    angle = np.linspace(0, 1, ANGLES) ** 2 * math.pi / 2
    color = 4 / (math.pi * weight) * np.array(specular)
    flat = np.ones((1, 2, 2, 2))  # azimuths, viewer angles, and 2 x 2 values
    tables = {
        "phi_i": np.zeros(1),
        "theta_i": np.array([0, math.pi / 2]),
        "ndf": np.tile(np.cos(angle) ** shininess, (2, 1)),
        "sigma": np.ones((2, 2)),
        "vndf": flat,
        "luminance": flat,
        "rgb": flat[:, :, None] * color[:, None, None],
    }
    return tensor_file(
        {"description": np.frombuffer(b"(n . h)^shininess", np.uint8)}
        | {name: table.astype("<f4") for name, table in tables.items()}
        | {"jacobian": np.ones(1, np.uint8)}
    )


def tensor_file(fields: dict[str, NDArray[np.uint8] | NDArray[np.float32]]) -> bytes:
    """Return named arrays as a tensor file, version 1.0."""
    starts = [2 + len(name) + 2 + 1 + 8 + 8 * table.ndim for name, table in fields.items()]
    head = b"tensor_file\0" + struct.pack("<BBI", 1, 0, len(fields))
    start, data = len(head) + sum(starts), b""
    for name, table in fields.items():
        kind = BYTE if table.dtype == np.uint8 else FLOAT
        head += struct.pack("<H", len(name)) + name.encode()
        head += struct.pack(f"<HBQ{table.ndim}Q", table.ndim, kind, start + len(data), *table.shape)
        data += table.tobytes()
    return head + data
