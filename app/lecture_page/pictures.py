"""Pictures in a page, as data URIs."""

from __future__ import annotations

import base64
import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image

QUALITY = 82


def data_uri(pixels: NDArray[np.uint8], is_small: bool = False) -> str:
    """Return a picture, uint8 (height, width, 3). is_small: with every pixel as it is."""
    file = io.BytesIO()
    image = Image.fromarray(np.ascontiguousarray(pixels))
    image.save(file, "WEBP", quality=QUALITY, lossless=is_small, method=4)
    return f"data:image/webp;base64,{base64.b64encode(file.getvalue()).decode()}"
