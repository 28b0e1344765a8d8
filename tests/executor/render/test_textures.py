"""Textures: their position on objects, in both renderers, and the files that are refused."""

import math
import struct
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from executor.render import geometry, look_at, make_renderer
from executor.render.interface import Renderer
from executor.render.mapping import coordinates
from executor.render.pieces import Pieces
from executor.render.tiny import TinyRenderer
from executor.universes import UniverseError, parse_universe
from executor.universes.model import TEXTURES
from executor.world.geometry.pictures import PictureError, image_size
from executor.world.interface import WorldError
from executor.world.physics.bullet import BulletWorld
from executor.world.physics.paint import textures_of

HEAD = (
    "format: bt-studio/universe\nversion: 1\nname: test\nrobots: []\nlights: [{direction: [0, 0.7, -0.7]}]\n"
)
WALL = "{id: wall, shape: box, size: [4, 0.2, 2], pose: [0, 3, 1, 0, 0, 0], texture: %s}"
QUAD = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\n%sf %s\n"


@pytest.fixture(scope="module")
def renderers() -> Iterator[tuple[Renderer, Renderer]]:
    pair = make_renderer(), TinyRenderer()
    yield pair
    for renderer in pair:
        renderer.close()


def world_of(models: str, assets: Path | None = None, ground: str = "{}") -> BulletWorld:
    return BulletWorld(parse_universe(f"{HEAD}ground: {ground}\nmodels: [{models}]\n"), assets=assets)


def shot(renderer: Renderer, world: BulletWorld) -> NDArray[np.uint8]:
    """Draws the wall's face at 100 pixels a metre."""
    renderer.load(world.scene)
    view = look_at((0, -1, 1), (0, 3, 1), 2 * math.atan(1.5 / 3.9))
    return renderer.draw(world.poses(), view, 300, 160, smooth=False)


def test_a_checkered_wall_changes_where_it_must(renderers: tuple[Renderer, Renderer]) -> None:
    world = world_of(WALL % "checker")
    picture = shot(renderers[0], world)
    row = picture[80 - 25, :, 0].astype(int) > 128  # a quarter of a metre above the middle
    edges = np.flatnonzero(np.diff(row)) + 1
    # The wall is visible from x = -1.5 to 1.5; its corner is at -2, and each square is half a metre wide.
    assert edges == pytest.approx([50, 100, 150, 200, 250], abs=1.5)
    upper, lower = picture[80 - 25, 25, 0], picture[80 + 25, 25, 0]
    assert abs(int(upper) - int(lower)) > 80
    world.close()


def test_both_renderers_agree_on_what_is_where_and_how_bright(
    renderers: tuple[Renderer, Renderer],
) -> None:
    ball = "{id: ball, shape: sphere, size: [0.4], pose: [0, 1, 0.4, 0, 0, 0], texture: wood}"
    models = f"{WALL % 'brick'}, {ball}"
    world = world_of(models, ground="{texture: grass}")
    view = look_at((1, -1.5, 1.5), (0, 2, 0.6))
    seen: list[Any] = []
    for renderer in renderers:
        renderer.load(world.scene)
        seen.append(
            [
                renderer.segmentation(world.poses(), view, 160, 120),
                renderer.draw(world.poses(), view, 160, 120, smooth=False),
            ]
        )
    same: Any = seen[0][0] == seen[1][0]
    assert same.mean() > 0.97
    for row in (-2, 0, 1):  # the ground, the wall, the ball
        colors = [picture[labels == row].mean(axis=0) for labels, picture in seen]
        hues = [color / color.sum() for color in colors]
        assert hues[0] == pytest.approx(hues[1], abs=0.05)
    world.close()


def test_a_scene_without_textures_after_one_with_them(renderers: tuple[Renderer, Renderer]) -> None:
    plain = world_of("{id: wall, shape: box, size: [4, 0.2, 2], pose: [0, 3, 1, 0, 0, 0]}")
    before = shot(renderers[0], plain)
    painted = world_of(WALL % "tiles", ground="{texture: tiles}")
    assert not np.array_equal(shot(renderers[0], painted), before)
    assert np.array_equal(shot(renderers[0], plain), before)
    assert plain.scene.textures == {}
    plain.close()
    painted.close()


def test_a_file_of_the_project_lies_as_it_is(tmp_path: Path, renderers: tuple[Renderer, Renderer]) -> None:
    picture = np.zeros((40, 80, 3), np.uint8)
    picture[:20, :, 2], picture[20:, :40, 1], picture[20:, 40:, 0] = 255, 255, 255  # red above green and blue
    cv2.imwrite(str(tmp_path / "flag.png"), picture)
    world = world_of((WALL % "flag.png").replace("}", ", tile: [4, 2]}"), tmp_path)
    shown = shot(renderers[0], world)
    assert [int(shown[y, x].argmax()) for y, x in ((20, 75), (130, 75), (130, 225))] == [0, 1, 2]
    world.close()


@pytest.mark.parametrize(
    ("lines", "corner"), [("", "1 2 3 4"), ("vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n", "1/1 2/2 3/3 4/4")]
)
def test_a_mesh_is_painted_by_its_own_coordinates_or_by_size(tmp_path: Path, lines: str, corner: str) -> None:
    (tmp_path / "quad.obj").write_text(QUAD % (lines, corner))
    world = world_of("{id: quad, shape: mesh, file: quad.obj, size: [2, 1, 3], texture: checker}", tmp_path)
    uvs = Pieces(world.scene).uvs[:, :2].max(axis=0)
    assert uvs == pytest.approx([1, 1] if lines else [2, 3])
    world.close()


def test_a_picture_goes_round_a_cylinder_and_a_ball_without_a_jump() -> None:
    for kind, shape in (("cylinder", geometry.cylinder()), ("sphere", geometry.capsule(1.0, 0.0))):
        points = shape[:, :3] * np.float32(0.3)
        uvs = coordinates(kind, points, shape[:, 3:6], (0.4, 0.4)).reshape(-1, 3, 2)
        side = np.abs(shape[:, 5].reshape(-1, 3)).max(axis=1) < 0.9
        spans = np.ptp(uvs[side, :, 0], axis=1)
        assert spans.max() < 5 / 16  # five times round, in 24 pieces
        assert np.ptp(uvs[side, :, 0]) == pytest.approx(5, abs=0.5)


def test_what_we_ship_is_small_and_neither_black_nor_white() -> None:
    models = ", ".join(f"{{id: {name}, shape: sphere, size: [1], texture: {name}}}" for name in TEXTURES)
    textures = textures_of(parse_universe(f"{HEAD}models: [{models}]\n"), None)
    assert set(textures) == set(TEXTURES)
    for texture in textures.values():
        assert len(texture.jpeg) < 20_000
        picture = cv2.imdecode(np.frombuffer(texture.jpeg, np.uint8), cv2.IMREAD_COLOR)
        assert 40 < picture.mean() < 240
    for name in ("asphalt", "carpet", "grass"):  # these are continuous at their edges
        data = np.frombuffer(textures[name].jpeg, np.uint8)
        picture = cv2.imdecode(data, cv2.IMREAD_GRAYSCALE).astype(int)
        for axis in (0, 1):
            inside = np.abs(np.diff(picture, axis=axis)).mean()
            assert np.abs(picture.take(0, axis) - picture.take(-1, axis)).mean() < 1.6 * inside


def png(width: int, height: int) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0))


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("no.png", None, "no such file"),
        ("../up.png", b"", "outside of the project"),
        ("text.png", b"hello", "neither a PNG nor a JPEG"),
        ("cut.png", png(16, 16), "damaged"),
        ("bomb.png", png(100_000, 100_000), "100000 by 100000 pixels"),
        ("empty.png", png(0, 5), "0 by 5 pixels"),
        ("cut.jpg", b"\xff\xd8\xff\xe0\x00\x10", "neither a PNG nor a JPEG"),
    ],
)
def test_a_picture_that_cannot_be_used_is_refused(
    tmp_path: Path, name: str, data: bytes | None, message: str
) -> None:
    if data:
        (tmp_path / name).write_bytes(data)
    with pytest.raises(WorldError, match=message):
        world_of(WALL % name, tmp_path)


def test_the_size_of_a_jpeg_is_read_without_unpacking_it() -> None:
    data = cv2.imencode(".jpg", np.zeros((30, 50, 3), np.uint8))[1].tobytes()
    assert image_size(data) == (50, 30)
    with pytest.raises(PictureError):
        image_size(data[:60])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("ground: {texture: marble}", "asphalt, brick"),
        ("ground: {tile: [1, 1]}", "needs a `texture`"),
        ("models: [{id: a, shape: urdf, file: a.urdf, texture: wood}]", "`texture` cannot be set"),
        ("ground: {texture: wood, tile: [0, 1]}", "greater than 0"),
    ],
)
def test_a_universe_says_what_a_texture_may_be(text: str, message: str) -> None:
    with pytest.raises(UniverseError, match=message):
        parse_universe(f"{HEAD}{text}\n")


def test_what_has_a_picture_keeps_its_colors_unless_it_is_tinted() -> None:
    ball = "shape: sphere, size: [1]"
    models = f"{{id: a, {ball}, texture: wood}}, {{id: b, {ball}, texture: wood, color: '#102030'}}"
    universe = parse_universe(f"{HEAD}models: [{models}, {{id: c, {ball}}}]\n")
    assert [model.color for model in universe.models] == ["#ffffff", "#102030", "#9aa4b0"]
