"""Pictures in a page: pixels as data URIs, and the laboratory's drawings as SVG."""

from __future__ import annotations

import base64
import io
import re
from typing import Literal

import numpy as np
from PIL import Image

from lucida.app.instruments.laboratory.page import Page
from lucida.app.instruments.laboratory.pages import drawn
from lucida.app.instruments.outside.svg import content
from lucida.renderer.images.display import Bytes

Form = Literal["webp", "jpeg"]
QUALITY = {"webp": 82, "jpeg": 85}
SMALL_PX = 256  # smaller pictures are drawn with square pixels
COLOR = re.compile(r'"(#[0-9a-f]{6})"')  # an attribute's value


def data_uri(pixels: Bytes, form: Form = "webp", is_exact: bool = False) -> str:
    """Return the data URI of a picture, (height, width, 3).

    form: PDF files keep JPEG unchanged. is_exact: lossless, for WebP.
    """
    file = io.BytesIO()
    image = Image.fromarray(np.ascontiguousarray(pixels))
    image.save(file, form, quality=QUALITY[form], lossless=is_exact)
    return f"data:image/{form};base64,{base64.b64encode(file.getvalue()).decode()}"


def drawing(themes: tuple[Page, Page], form: Form = "webp") -> str:
    """Return the elements of a laboratory's drawing as SVG, in the colours of the reader's theme.

    themes: the drawing in the light and in the dark theme. form: of its pictures.
    """

    def address(pixels: Bytes) -> str:
        is_small = pixels.shape[1] <= SMALL_PX
        return data_uri(pixels, "webp" if is_small else form, is_small)

    light, dark = ("\n".join(content(drawn(page), address)) for page in themes)
    others = iter(COLOR.findall(dark))  # both themes draw the same elements
    return COLOR.sub(lambda color: f'"light-dark({color[1]}, {next(others)})"', light)
