"""Images: the display transform, pictures of channels, and files by their ending."""

from .display import encode_srgb, from_srgb, gray_picture, picture, to_srgb8
from .files import (
    ENDINGS,
    PICTURES,
    check_image_path,
    encode_image,
    join_exrs,
    write_image,
    write_picture,
)

__all__ = [
    "ENDINGS",
    "PICTURES",
    "check_image_path",
    "encode_image",
    "encode_srgb",
    "from_srgb",
    "gray_picture",
    "join_exrs",
    "picture",
    "to_srgb8",
    "write_image",
    "write_picture",
]
