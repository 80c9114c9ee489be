"""Pictures in a page, as data URIs."""

from __future__ import annotations

import base64
import io
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image

QUALITY = {"webp": 82, "jpeg": 85}


def data_uri(
    pixels: NDArray[np.uint8], form: Literal["webp", "jpeg"] = "webp", is_exact: bool = False
) -> str:
    """Return a picture, uint8 (height, width, 3).

    form: PDF files take JPEG as it is. is_exact: with every pixel as it is, in WebP.
    """
    file = io.BytesIO()
    image = Image.fromarray(np.ascontiguousarray(pixels))
    image.save(file, form, quality=QUALITY[form], lossless=is_exact)
    return f"data:image/{form};base64,{base64.b64encode(file.getvalue()).decode()}"
