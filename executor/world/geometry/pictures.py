"""The mean colours of pictures, which stand for them on meshes."""

from __future__ import annotations

from typing import Final

import cv2
import numpy as np

__all__ = ["MAX_PIXELS", "PictureError", "image_size", "mean_color", "shrunk"]

MAX_PIXELS: Final = 17_000_000
SMALL_SIDE: Final = 64
"""Of the copies that an import makes: enough for the mean colour."""
_MEAN_SIDE: Final = 1024
"""A narrow picture is decoded whole: as numbers, its millions of pixels would take 400 MB."""
_MARKERS_WITHOUT_SIZE: Final = frozenset({0xC4, 0xC8, 0xCC})


class PictureError(Exception):
    """A picture cannot be used; the text is the reason."""


def image_size(data: bytes) -> tuple[int, int]:
    """Returns the width and height of a PNG or JPEG without decoding it.

    Raises:
        PictureError: the data are neither a PNG nor a JPEG.
    """
    if data.startswith(b"\x89PNG\r\n\x1a\n") and len(data) >= 24:
        return int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")
    at = 2
    while data.startswith(b"\xff\xd8") and at + 9 < len(data) and data[at] == 0xFF:
        marker = data[at + 1]
        if 0xC0 <= marker <= 0xCF and marker not in _MARKERS_WITHOUT_SIZE:
            return int.from_bytes(data[at + 7 : at + 9], "big"), int.from_bytes(data[at + 5 : at + 7], "big")
        at += 2 + int.from_bytes(data[at + 2 : at + 4], "big")
    raise PictureError("the file is neither a PNG nor a JPEG")


def mean_color(data: bytes) -> tuple[float, float, float] | None:
    """Returns the mean colour of a PNG or JPEG, 0 to 1 in sRGB; None if it cannot be read."""
    picture = _decoded(data)
    if picture is None:
        return None
    picture = _reduced(picture, _MEAN_SIDE)
    blue, green, red = np.sqrt(((picture / 255.0) ** 2).mean(axis=(0, 1))).tolist()
    return round(red, 3), round(green, 3), round(blue, 3)


def shrunk(data: bytes) -> bytes | None:
    """Returns a small PNG of a picture; None if it cannot be read."""
    picture = _decoded(data)
    if picture is None:
        return None
    return bytes(cv2.imencode(".png", _reduced(picture, SMALL_SIDE))[1])


def _reduced(picture: np.ndarray, most: int) -> np.ndarray:
    """Returns a picture whose longer side is at most so many pixels."""
    share = most / max(picture.shape[:2])
    if share >= 1:
        return picture
    height, width = (max(round(share * side), 1) for side in picture.shape[:2])
    small: np.ndarray = cv2.resize(picture, (width, height), interpolation=cv2.INTER_AREA)
    return small


def _decoded(data: bytes) -> np.ndarray | None:
    try:
        width, height = image_size(data)
    except PictureError:
        return None
    if not 0 < width * height <= MAX_PIXELS:
        return None
    # A large JPEG is decoded at an eighth of its size, which is quick and has the same mean.
    mode = cv2.IMREAD_REDUCED_COLOR_8 if min(width, height) >= 8 * SMALL_SIDE else cv2.IMREAD_COLOR
    try:
        return cv2.imdecode(np.frombuffer(data, np.uint8), mode)
    except cv2.error:
        return None
