"""Textures of a universe."""

from __future__ import annotations

import pytest

from executor.universes.model import TEXTURES
from executor.world.geometry.pictures import PictureError, image_size
from executor.world.physics.paint import shipped


@pytest.mark.parametrize("name", sorted(TEXTURES))
def test_what_we_ship_is_a_picture_with_its_size(name: str) -> None:
    data, tile = shipped(name)
    width, height = image_size(data)
    assert width == height > 0
    assert min(tile) > 0


def test_what_is_no_picture_is_refused() -> None:
    with pytest.raises(PictureError):
        image_size(b"nonsense")
