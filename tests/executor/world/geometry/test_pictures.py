"""The mean colours of pictures, and their small copies."""

from __future__ import annotations

import tracemalloc

import cv2
import numpy as np
import pytest

from executor.world.geometry.pictures import PictureError, image_size, mean_color, shrunk


def picture(suffix: str, side: int = 80) -> bytes:
    """Returns a picture that is half red and half black."""
    bgr = np.zeros((side, side, 3), np.uint8)
    bgr[:, : side // 2, 2] = 255
    return bytes(cv2.imencode(suffix, bgr)[1])


@pytest.mark.parametrize("suffix", [".png", ".jpg"])
@pytest.mark.parametrize("side", [80, 1024])
def test_the_mean_is_that_of_what_is_seen_and_a_small_copy_keeps_it(suffix: str, side: int) -> None:
    data = picture(suffix, side)
    assert image_size(data) == (side, side)
    assert mean_color(data) == pytest.approx((0.707, 0, 0), abs=0.02)
    small = shrunk(data)
    assert small is not None
    assert max(image_size(small)) <= 128
    assert mean_color(small) == pytest.approx((0.707, 0, 0), abs=0.02)


@pytest.mark.parametrize("data", [b"", b"8BPS", picture(".png")[:60], picture(".jpg")[:30]])
def test_what_is_no_picture_has_none(data: bytes) -> None:
    assert mean_color(data) is None
    assert shrunk(data) is None


def test_a_picture_of_too_many_pixels_is_not_decoded() -> None:
    data = bytearray(picture(".png"))
    data[16:24] = (100_000).to_bytes(4, "big") * 2
    assert mean_color(bytes(data)) is None
    with pytest.raises(PictureError, match="neither"):
        image_size(b"GIF89a")


def test_a_narrow_picture_is_small_before_it_becomes_numbers() -> None:
    bgr = np.zeros((34_000, 500, 3), np.uint8)
    bgr[:, :250, 2] = 255
    data = bytes(cv2.imencode(".png", bgr)[1])
    tracemalloc.start()
    try:
        assert mean_color(data) == pytest.approx((0.707, 0, 0), abs=0.03)
        assert tracemalloc.get_traced_memory()[1] < 2 * bgr.nbytes
    finally:
        tracemalloc.stop()


def test_a_line_has_a_small_copy() -> None:
    line = np.full((20_000, 1, 3), 255, np.uint8)
    small = shrunk(bytes(cv2.imencode(".png", line)[1]))
    assert small is not None
    assert image_size(small) == (1, 64)
