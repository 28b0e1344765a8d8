"""Textures as layers of a renderer."""

from __future__ import annotations

import cv2
import msgspec
import numpy as np
import pytest

from executor.messages import Texture
from executor.render.layers import SIDE, mean_color, pixels


def texture(jpeg: bytes) -> Texture:
    fields = {field.name: field for field in msgspec.structs.fields(Texture)}
    values: dict[str, object] = {"jpeg": jpeg, "name": "t", "id": "t", "size": [1.0, 1.0], "tile": [1.0, 1.0]}
    return Texture(**{name: values[name] for name in fields if name in values})  # type: ignore[arg-type]


def encoded(bgr: tuple[int, int, int]) -> bytes:
    picture = np.full((8, 8, 3), bgr, np.uint8)
    return cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, 100])[1].tobytes()


def test_a_picture_becomes_a_layer_of_rgb() -> None:
    layer = pixels(texture(encoded((0, 0, 255))))
    assert layer.shape == (SIDE, SIDE, 3)
    assert layer[0, 0, 0] > 240
    red, _, blue = mean_color(texture(encoded((0, 0, 255))))
    assert red > 0.9
    assert blue < 0.1


def test_what_is_no_picture_is_refused() -> None:
    with pytest.raises(ValueError, match="no picture"):
        pixels(texture(b"nonsense"))
