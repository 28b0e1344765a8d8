"""The README's moving picture: small, moving, and made of pictures that are shown as long as they lasted."""

from __future__ import annotations

from typing import TYPE_CHECKING

import cv2
import numpy as np
import pytest

from tests.tools.moving_picture import (
    HEIGHT,
    MOST_BYTES,
    PICTURE,
    ROOT,
    WIDTH,
    Shot,
    durations,
    reduced,
    write,
)

if TYPE_CHECKING:
    from pathlib import Path


def test_the_readme_shows_a_picture_that_moves_and_is_small():
    assert str(PICTURE.relative_to(ROOT)) in (ROOT / "README.md").read_text(encoding="utf-8")
    assert PICTURE.stat().st_size <= MOST_BYTES
    read, animation = cv2.imreadanimation(str(PICTURE))
    assert read
    assert len(animation.frames) > 20
    assert not np.array_equal(animation.frames[0], animation.frames[-1])


def test_each_picture_is_shown_until_the_next_one():
    assert durations([0.0, 0.25, 1.0], last_msec=500) == [250, 750, 500]


def test_a_screenshot_is_reduced_and_what_is_none_is_refused():
    page = np.zeros((800, 1280, 3), np.uint8)
    assert reduced(cv2.imencode(".png", page)[1].tobytes()).shape == (HEIGHT, WIDTH, 3)
    with pytest.raises(ValueError, match="no picture"):
        reduced(b"no png")


def test_pictures_that_are_too_large_are_not_left_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    shots = [
        Shot(time, np.full((HEIGHT, WIDTH, 3), shade, np.uint8)) for time, shade in ((0.0, 0), (1.0, 255))
    ]
    file = tmp_path / "run.webp"
    assert write(shots, file) == file.stat().st_size
    monkeypatch.setattr("tests.tools.moving_picture.MOST_BYTES", 10)
    with pytest.raises(ValueError, match="show less of the run"):
        write(shots, file)
    assert not file.exists()
