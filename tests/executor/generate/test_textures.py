"""The editor's textures equal those of the world."""

import json
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from executor.generate import textures
from executor.universes.model import TEXTURES

COMMITTED = textures.FOLDER


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Returns the files that the command writes."""
    folder = tmp_path_factory.mktemp("generated") / "textures"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(textures, "FOLDER", folder)
        textures.main()
    return folder


def pixels(path: Path) -> NDArray[np.int_]:
    picture = cv2.imread(str(path), cv2.IMREAD_COLOR)
    assert picture is not None
    return picture.astype(np.int_)


def test_the_committed_files_are_those_that_the_command_writes(written: Path) -> None:
    def names(folder: Path) -> list[str]:
        return sorted(path.name for path in folder.iterdir())

    assert names(COMMITTED) == names(written) == sorted([*(f"{name}.jpg" for name in TEXTURES), "tiles.json"])


@pytest.mark.parametrize("name", TEXTURES)
def test_a_committed_picture_is_what_the_command_draws(written: Path, name: str) -> None:
    drawn, committed = pixels(written / f"{name}.jpg"), pixels(COMMITTED / f"{name}.jpg")
    assert drawn.shape == committed.shape
    assert np.abs(drawn - committed).mean() < 1  # another libjpeg may round slightly differently
    assert drawn.std() > 3, "it shows something"


def test_the_committed_sizes_are_those_of_the_pictures(written: Path) -> None:
    assert (COMMITTED / "tiles.json").read_text() == (written / "tiles.json").read_text()
    tiles = json.loads((COMMITTED / "tiles.json").read_text())
    assert all(0 < width <= 10 and 0 < height <= 10 for width, height in tiles.values())
