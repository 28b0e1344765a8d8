"""Converts textures of a scene to the form that renderers need."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import cv2
import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.messages import Texture

SIDE: Final = 512
"""Width and height of a layer in pixels."""


def pixels(texture: Texture) -> NDArray[np.uint8]:
    """Returns a picture as a layer: RGB, the bottom row first, as OpenGL counts."""
    bgr = cv2.imdecode(np.frombuffer(texture.jpeg, np.uint8), cv2.IMREAD_COLOR)
    if bgr is None:
        raise ValueError("a texture of the scene is no picture")
    how = cv2.INTER_AREA if max(bgr.shape[:2]) > SIDE else cv2.INTER_LINEAR
    scaled = cv2.resize(bgr, (SIDE, SIDE), interpolation=how)
    return np.ascontiguousarray(scaled[::-1, :, ::-1], np.uint8)


def mean_color(texture: Texture) -> tuple[float, float, float]:
    """Returns the mean colour of a texture, 0 to 1 in sRGB."""
    # Light is additive in linear colour space only; squaring approximates the decoding of sRGB.
    red, green, blue = np.sqrt(((pixels(texture) / 255.0) ** 2).mean(axis=(0, 1))).tolist()
    return red, green, blue
