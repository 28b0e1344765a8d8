"""Pictures as JPEG."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import simplejpeg

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["BEST_QUALITY", "to_jpeg"]

BEST_QUALITY: Final = 82
"""The quality of pictures for clients that are fast enough, and of recorded ones: so each is coded once."""


def to_jpeg(picture: NDArray[np.uint8], quality: int = BEST_QUALITY) -> bytes:
    """Returns a picture [row, column, RGB] as JPEG, with half the resolution in colour."""
    coded: bytes = simplejpeg.encode_jpeg(picture, quality=quality, colorspace="RGB", colorsubsampling="420")
    return coded
