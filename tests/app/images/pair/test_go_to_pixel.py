"""Reading a typed row and column."""

import pytest

from lucida.app.images.pair.boxes import parsed_pixel
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.system.errors import LucidaError

SIZE = (8, 6)


@pytest.mark.parametrize(
    ("texts", "indexing", "pixel"),
    [
        (("1", "1"), Indexing.LECTURE, (0, 0)),
        ((" 6 ", "8"), Indexing.LECTURE, (5, 7)),
        (("0", "0"), Indexing.ARRAY, (0, 0)),
        (("5", "7"), Indexing.ARRAY, (5, 7)),
    ],
)
def test_a_typed_pixel_is_read_in_either_indexing(texts, indexing, pixel):
    assert parsed_pixel(texts, SIZE, indexing) == pixel


@pytest.mark.parametrize(
    ("texts", "indexing", "message"),
    [
        (("0", "1"), Indexing.LECTURE, "'0' is no row of this image; give 1 to 6"),
        (("7", "1"), Indexing.LECTURE, "'7' is no row of this image; give 1 to 6"),
        (("1", "9"), Indexing.LECTURE, "'9' is no column of this image; give 1 to 8"),
        (("6", "1"), Indexing.ARRAY, "'6' is no row of this image; give 0 to 5"),
        (("1.5", "1"), Indexing.ARRAY, "'1.5' is no row"),
        (("٣", "1"), Indexing.ARRAY, "is no row"),
        (("1", "9" * 5000), Indexing.ARRAY, "is no column"),
    ],
)
def test_a_typed_mistake_is_refused(texts, indexing, message):
    with pytest.raises(LucidaError) as caught:
        parsed_pixel(texts, SIZE, indexing)
    assert message in str(caught.value)
