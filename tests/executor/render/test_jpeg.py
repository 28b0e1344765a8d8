"""Pictures as JPEG."""

from __future__ import annotations

import numpy as np
import simplejpeg

from executor.render.jpeg import BEST_QUALITY, to_jpeg


def test_a_picture_comes_back_and_a_lower_quality_is_smaller():
    rows, columns = np.mgrid[0:48, 0:64]
    picture = np.stack([rows * 5, columns * 3, rows + columns], axis=2).astype(np.uint8)
    coded = to_jpeg(picture)
    read = simplejpeg.decode_jpeg(coded, colorspace="RGB")
    assert np.abs(read.astype(int) - picture).mean() < 4
    assert coded == to_jpeg(picture, BEST_QUALITY)
    assert len(to_jpeg(picture, 20)) < len(coded)
