"""Pictures of heights become triangles."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from lxml import etree

from executor.imports.heightmaps import MOST_SAMPLES, heightmap_mesh
from executor.sdf.files import MemoryFiles

SHAPE = etree.fromstring("<heightmap bts_file='w'><uri>h.png</uri><size>4 4 2</size></heightmap>")


def made(picture: np.ndarray) -> tuple[np.ndarray, list[str]]:
    said: list[str] = []
    raw = cv2.imencode(".png", picture)[1].tobytes()
    found = heightmap_mesh(SHAPE, MemoryFiles({"h.png": raw}), lambda _, message: said.append(message))
    assert found is not None
    return found[0][found[1]], said


@pytest.mark.parametrize("kind", [np.uint8, np.uint16])
def test_white_is_the_top(kind: type) -> None:
    picture: np.ndarray = np.zeros((3, 3), kind)
    picture[1, 1] = np.iinfo(kind).max
    triangles, said = made(picture)
    assert triangles.reshape(-1, 3)[:, 2].max() == 2
    top = triangles.reshape(-1, 3)[triangles.reshape(-1, 3)[:, 2] > 1]
    assert np.allclose(top, [0, 0, 2])
    assert not said


def test_all_triangles_look_up() -> None:
    triangles, _ = made(np.arange(16, dtype=np.uint8).reshape(4, 4))
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    assert (normals[:, 2] > 0).all()


def test_a_large_picture_is_made_smaller_and_it_is_said() -> None:
    triangles, said = made(np.zeros((600, 400), np.uint8))
    assert len(triangles) == 2 * (MOST_SAMPLES - 1) ** 2
    assert "samples along a side" in said[0]


@pytest.mark.parametrize("raw", [b"", b"no picture"])
def test_what_is_no_picture_is_left_out(raw: bytes) -> None:
    said: list[str] = []
    assert heightmap_mesh(SHAPE, MemoryFiles({"h.png": raw}), lambda _, message: said.append(message)) is None
    assert "is no picture" in said[0]
