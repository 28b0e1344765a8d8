"""Occupancy maps become walls."""

from __future__ import annotations

import math

import cv2
import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from executor.imports.maps import import_map, is_map, rectangles
from executor.sdf.files import MemoryFiles
from executor.universes import UniverseError, parse_universe
from executor.world.physics.bullet import BulletWorld

MAP = """image: {image}
resolution: 0.5
origin: [{origin}]
negate: {negate}
occupied_thresh: 0.65
free_thresh: 0.25
"""


def flat() -> np.ndarray:
    picture = np.full((6, 8), 254, np.uint8)
    picture[0, :] = picture[-1, :] = 0
    picture[:, 0] = picture[:, -1] = 0
    picture[2, 4] = 205  # unknown
    return picture


def made(picture: np.ndarray, *, image: str = "map.pgm", origin: str = "-1, -2, 0", negate: int = 0):
    raw = cv2.imencode(image[image.rindex(".") :], picture)[1].tobytes()
    text = MAP.format(image=image, origin=origin, negate=negate).encode()
    return import_map(text, "maps/flat.yaml", MemoryFiles({f"maps/{image}": raw}))


def walls(text: str) -> list[dict]:
    return yaml.safe_load(text)["models"]


@pytest.mark.parametrize("image", ["map.pgm", "map.png"])
def test_walls_stand_where_the_map_has_them(image: str) -> None:
    imported = made(flat(), image=image)
    found = {tuple(wall["pose"][:2]): tuple(wall["size"][:2]) for wall in walls(imported.text)}
    assert found == {
        (1.0, -1.75): (4.0, 0.5),
        (1.0, 0.75): (4.0, 0.5),
        (-0.75, -0.5): (0.5, 2.0),
        (2.75, -0.5): (0.5, 2.0),
    }
    assert (imported.things, imported.left_out) == (4, [])


@pytest.mark.parametrize("white", [1, 100, 254, 255, 1000, 65535])
@pytest.mark.parametrize("kind", ["P2", "P5"])
def test_white_is_what_the_picture_says(kind: str, white: int) -> None:
    """Whatever number a PGM has for white, the same cells are occupied."""
    values = [0 if value == 0 else white for value in flat().ravel().tolist()]
    if kind == "P2":
        cells = " ".join(map(str, values)).encode()
    else:
        cells = b"".join(value.to_bytes(1 if white < 256 else 2, "big") for value in values)
    raw = f"{kind}\n# CREATOR: a mapper 0.05\n8 6 # m\n{white}\n".encode() + cells
    text = MAP.format(image="map.pgm", origin="-1, -2, 0", negate=0).encode()
    imported = import_map(text, "maps/flat.yaml", MemoryFiles({"maps/map.pgm": raw}))
    assert walls(imported.text) == walls(made(flat()).text)


def test_a_ray_meets_them() -> None:
    world = BulletWorld(parse_universe(made(flat()).text))
    hit = world._bullet.rayTest([1, -0.5, 0.5], [10, -0.5, 0.5])[0][3]
    world.close()
    assert hit[0] == pytest.approx(2.5, abs=1e-3)


def test_the_origin_may_be_turned_and_the_colours_negated() -> None:
    turned = made(flat(), origin="0, 0, 1.5707963")
    corner = min(walls(turned.text), key=lambda wall: wall["pose"][0])
    assert corner["pose"][5] == pytest.approx(math.pi / 2, abs=1e-5)
    assert all(wall["pose"][0] < 0 for wall in walls(turned.text))
    assert len(walls(made(255 - flat(), negate=1).text)) == 4


def test_colours_and_transparency_are_read_as_shades() -> None:
    colours = np.zeros((4, 4, 4), np.uint8)
    colours[1, 1] = (0, 0, 0, 255)
    assert len(walls(made(colours, image="map.png").text)) == 1


@given(st.lists(st.lists(st.booleans(), min_size=7, max_size=7), min_size=1, max_size=7))
def test_rectangles_cover_each_cell_once(rows: list[list[bool]]) -> None:
    cells = np.array(rows)
    covered = np.zeros(cells.shape, int)
    for column, row, columns, count in rectangles(cells):
        covered[row : row + count, column : column + columns] += 1
    assert (covered == cells).all()


def test_a_map_of_dust_is_read_with_coarser_cells() -> None:
    dust = np.where(np.indices((200, 200)).sum(axis=0) % 2 == 0, 0, 254).astype(np.uint8)
    imported = made(dust)
    assert 0 < imported.things <= 2000
    assert "its cells are 1 m here" in imported.left_out[0].message


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("resolution: 1\norigin: [0, 0, 0]\n", "`image`"),
        ("image: a.pgm\nresolution: 0\norigin: [0, 0, 0]\n", "`resolution`"),
        ("image: a.pgm\nresolution: 1\norigin: 3\n", "`origin`"),
        ("image: a.pgm\nresolution: 1\norigin: [0, 0, x]\n", "`origin`"),
        ("image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\noccupied_thresh: 7\n", "`occupied_thresh`"),
        ("image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\n", "no such file"),
        ("image: ../../a.pgm\nresolution: 1\norigin: [0, 0, 0]\n", "outside"),
        ("image: bad.pgm\nresolution: 1\norigin: [0, 0, 0]\n", "no PGM or PNG"),
        ("image: white.png\nresolution: 1\norigin: [0, 0, 0]\n", "no cell of the map is occupied"),
        ("a: [", r"flat\.yaml:2"),
    ],
)
def test_other_maps_are_refused_with_their_line(text: str, message: str) -> None:
    white = cv2.imencode(".png", np.full((3, 3), 255, np.uint8))[1].tobytes()
    with pytest.raises(UniverseError, match=message):
        import_map(text.encode(), "flat.yaml", MemoryFiles({"bad.pgm": b"x", "white.png": white}))


def test_a_map_and_a_universe_are_kept_apart() -> None:
    assert is_map(MAP.format(image="a", origin="0,0,0", negate=0))
    assert not any(map(is_map, ("format: bt-studio/universe\n", "[", "- 1\n")))
