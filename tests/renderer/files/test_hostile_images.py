"""Images: how large one may be in every place that holds it; damaged and hostile ones."""

from __future__ import annotations

import contextlib
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from textured import noise

from lucida.renderer.files.texture_images import FoundImage, ModelImages, decode_image, inner_path
from lucida.renderer.raster.tables import TABLE_WIDTH
from lucida.renderer.scene.limits import IMAGE_BYTES, JPEG_SCANS, TEXELS, TEXTURE_SIDE
from lucida.renderer.system.errors import LucidaError

USUAL_SIDE = 16384  # GL_MAX_TEXTURE_SIZE of graphics cards, and of Mesa's software


def test_the_largest_texture_fits_everywhere() -> None:
    """With its border among a scene's texels, whose table is wrapped into a texture of the driver;
    in a file that is not compressed, four bytes a pixel."""
    assert (TEXTURE_SIDE + 1) ** 2 <= TEXELS
    assert TABLE_WIDTH <= USUAL_SIDE and -(-TEXELS // TABLE_WIDTH) <= USUAL_SIDE
    assert 4 * TEXTURE_SIDE**2 + 4096 <= IMAGE_BYTES


def png_that_declares(width: int, height: int) -> bytes:
    """A small file of a large image: a bomb."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        body = kind + data
        return len(data).to_bytes(4, "big") + body + zlib.crc32(body).to_bytes(4, "big")

    head = width.to_bytes(4, "big") + height.to_bytes(4, "big") + bytes([8, 2, 0, 0, 0])
    body = zlib.compress(b"\0" * 1000)
    parts = chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + parts


@pytest.mark.parametrize("side", [TEXTURE_SIDE + 1, 60_000, (1 << 31) - 1])
def test_a_decompression_bomb_is_refused_by_its_header(side: int, monkeypatch) -> None:
    monkeypatch.setattr(Image.Image, "load", None)
    with pytest.raises(LucidaError, match=r"pixels|is cut off or damaged"):
        decode_image(png_that_declares(side, side))


def test_a_jpeg_of_endless_scans_is_refused() -> None:
    with pytest.raises(LucidaError, match="scans"):
        decode_image(b"\xff\xd8" + b"\xff\xda\x00" * (JPEG_SCANS + 1))


def test_images_of_other_kinds_of_pixels(tmp_path: Path) -> None:
    """Gray, palette, opacity, 16 bits: all become red, green and blue of 8 bits."""
    gray = np.arange(64, dtype=np.uint8).reshape(8, 8) * 4
    path = tmp_path / "i.png"
    for image in (
        Image.fromarray(gray),
        Image.fromarray(gray.astype(np.uint16) * 256),
        Image.fromarray(np.dstack([gray, gray, gray, gray // 2])),
        Image.fromarray(gray).convert("P"),
    ):
        image.save(path)
        np.testing.assert_array_equal(decode_image(path.read_bytes())[..., 1], gray)


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "BMP", "TGA", "GIF", "WEBP", "PPM"])
def test_damaged_images_raise_one_kind_of_error(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "image"
    Image.fromarray(noise(24, 16)).save(path, format=kind)
    whole = path.read_bytes()
    whole_pixels = decode_image(whole)
    assert whole_pixels.shape == (16, 24, 3)
    random = np.random.default_rng(5)
    for _ in range(60):
        data = bytearray(whole)
        for at in random.integers(0, len(data), 4):
            data[at] = random.integers(256)
        cut = bytes(data[: random.integers(1, len(data) + 1)])
        pixels = whole_pixels
        with contextlib.suppress(LucidaError):  # and no other exception
            pixels = decode_image(cut)
        assert pixels.dtype == np.uint8 and pixels.shape[2] == 3


def test_names_that_lead_outside(tmp_path: Path) -> None:
    assert inner_path("a/../b.png", tmp_path) == tmp_path / "a/../b.png"
    for name in ("..", "a/../../b.png", "/b.png", "\\\\host\\b.png", "C:/b.png", "\0"):
        with pytest.raises(LucidaError, match="is not in the folder"):
            inner_path(name, tmp_path)


def test_the_images_of_a_model_are_counted_together_and_each_once(monkeypatch) -> None:
    monkeypatch.setattr("lucida.renderer.files.texture_images.TEXELS", 100)
    images = ModelImages()

    def shown(name: str, side: int) -> bool:
        return images.get(name, lambda: FoundImage(noise(side, side))) is not None

    assert [shown(name, 6) for name in "aaba"] == [True] * 4
    assert not images.notes
    assert not shown("c", 6) and not shown("c", 1)  # refused once: it stays so
    assert len(images.notes) == 1 and "all images together have more than" in images.notes[0]
    assert shown("d", 5) and not shown("e", 2)  # what was refused is not counted
    monkeypatch.setattr("lucida.renderer.files.texture_images.TEXTURES", 5)
    assert not shown("f", 0) and "there are more than 5" in images.notes[1]


def test_an_image_of_floating_point_numbers_is_refused() -> None:
    numbers = np.full((2, 2), 0.5, "<f4").tobytes()
    with pytest.raises(LucidaError, match="holds floating-point numbers; save it as PNG"):
        decode_image(b"Pf\n2 2\n-1.0\n" + numbers)
