"""Textures: procedural built-in ones, and image files of a project."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Final

import cv2
import numpy as np

from executor.messages import Texture
from executor.universes.model import TEXTURES
from executor.world.geometry.pictures import MAX_PIXELS, PictureError, image_size
from executor.world.interface import WorldError

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from numpy.typing import NDArray

    from executor.universes.model import Ceiling, Ground, Model, Universe

    Painted = Model | Ground | Ceiling
    Grey = NDArray[np.float64]
    Picture = NDArray[np.float64]

SIZE: Final = 256
MAX_BYTES: Final = 10_000_000
LARGEST_SIDE: Final = 1024
QUALITY: Final = 82


def textures_of(universe: Universe, assets: Path | None) -> dict[str, Texture]:
    """Returns all textures of a universe, by the keys of `texture_key`.

    Raises:
        WorldError: an image file is missing or cannot be used.
    """
    found: dict[str, Texture] = {}
    painted: list[tuple[str, Painted]] = [("the ground", universe.ground)]
    painted += [("the ceiling", universe.ceiling)] if universe.ceiling else []
    painted += [(model.id, model) for model in universe.models]
    for name, thing in painted:
        key = texture_key(thing)
        if not key or key in found:
            continue
        try:
            jpeg, tile = shipped(thing.texture) if thing.texture in TEXTURES else _own(thing.texture, assets)
        except PictureError as error:
            raise WorldError(f"the texture {thing.texture!r} of {name} cannot be used: {error}") from error
        found[key] = Texture(jpeg, list(thing.tile or tile))
    return found


def texture_key(thing: Painted) -> str:
    """Returns the key of a texture in the scene; each size of a texture has its own key."""
    tile = "" if thing.tile is None else f"@{thing.tile[0]:g}x{thing.tile[1]:g}"
    return f"{thing.texture}{tile}" if thing.texture else ""


def _own(name: str, assets: Path | None) -> tuple[bytes, tuple[float, float]]:
    if assets is None:
        raise PictureError("there are no project files to take it from")
    path = assets / name
    if not path.resolve().is_relative_to(assets.resolve()):
        raise PictureError("it lies outside of the project")
    if not path.is_file():
        raise PictureError("there is no such file")
    if path.stat().st_size > MAX_BYTES:
        raise PictureError(f"it is larger than {MAX_BYTES // 1_000_000} MB")
    data = path.read_bytes()
    width, height = image_size(data)
    if not 0 < width * height <= MAX_PIXELS:
        raise PictureError(
            f"it has {width} by {height} pixels; {MAX_PIXELS // 1_000_000} million are the most"
        )
    picture = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
    if picture is None:
        raise PictureError("it is damaged")
    shrink = LARGEST_SIDE / max(picture.shape[:2])
    if shrink < 1:
        picture = cv2.resize(picture, None, fx=shrink, fy=shrink, interpolation=cv2.INTER_AREA)
    return _jpeg(picture), (1.0, picture.shape[0] / picture.shape[1])


def _jpeg(bgr: NDArray[np.uint8]) -> bytes:
    return bytes(cv2.imencode(".jpg", bgr, [cv2.IMWRITE_JPEG_QUALITY, QUALITY])[1])


@functools.cache
def shipped(name: str) -> tuple[bytes, tuple[float, float]]:
    """Returns a built-in texture as JPEG, and the width and height in m that it covers."""
    draw, tile = _PAINTERS[name]
    rgb = np.clip(draw(np.random.default_rng(7)), 0.0, 1.0) * 255
    return _jpeg(np.ascontiguousarray(rgb[:, :, ::-1].round().astype(np.uint8))), tile


def _cells() -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    rows, columns = np.indices((SIZE, SIZE))
    return rows, columns


def _noise(generator: np.random.Generator, across: float, down: float) -> Grey:
    """Returns tileable noise from about -1 to 1, with grains of these sizes in pixels."""
    spectrum = np.fft.fft2(generator.normal(size=(SIZE, SIZE)))
    fy, fx = np.fft.fftfreq(SIZE)[:, None], np.fft.fftfreq(SIZE)[None, :]
    spectrum *= np.exp(-((fx * across) ** 2 + (fy * down) ** 2) * np.pi)
    grey = np.fft.ifft2(spectrum).real
    grey -= grey.mean()
    smooth: Grey = grey / (2 * grey.std())
    return smooth


def _paint(color: tuple[float, float, float], shade: Grey) -> Picture:
    return np.array(color) * shade[:, :, None]


def _checker(_: np.random.Generator) -> Picture:
    rows, columns = _cells()
    is_dark = (rows * 2 // SIZE + columns * 2 // SIZE) % 2
    return _paint((1.0, 1.0, 1.0), np.where(is_dark, 0.30, 0.92))


def _wood(generator: np.random.Generator) -> Picture:
    """Returns a picture of four wooden boards, each of two pieces."""
    rows, columns = _cells()
    board = rows * 4 // SIZE
    joint = np.array([40, 168, 100, 228])[board]
    piece = board * 2 + (((columns - joint) % SIZE) * 2 // SIZE)
    shade = 1 + generator.uniform(-0.12, 0.10, 8)[piece]
    shade = shade + 0.10 * _noise(generator, 90, 3) + 0.05 * _noise(generator, 30, 1.2)
    gap = (rows % (SIZE // 4) < 1) | ((columns - joint) % (SIZE // 2) < 1)
    return _paint((0.68, 0.47, 0.29), np.where(gap, shade * 0.55, shade))


def _brick(generator: np.random.Generator) -> Picture:
    """Returns a picture of eight rows of four bricks, each row shifted by half a brick."""
    rows, columns = _cells()
    high, wide = SIZE // 8, SIZE // 4
    row = rows // high
    at = (columns + (row % 2) * wide // 2) % SIZE
    brick = row * 4 + at // wide
    shade = 1 + generator.uniform(-0.16, 0.12, 32)[brick] + 0.10 * _noise(generator, 5, 4)
    is_mortar = (rows % high < 3) | (at % wide < 3)
    mortar = _paint((0.74, 0.71, 0.66), 1 + 0.08 * _noise(generator, 3, 3))
    return np.where(is_mortar[:, :, None], mortar, _paint((0.64, 0.31, 0.23), shade))


def _carpet(generator: np.random.Generator) -> Picture:
    rows, columns = _cells()
    weave = 0.05 * np.sin(columns * np.pi / 4) * np.sin(rows * np.pi / 4)
    return _paint(
        (0.86, 0.84, 0.80), 1 + weave + 0.10 * _noise(generator, 2, 2) + 0.04 * _noise(generator, 50, 50)
    )


def _tiles(generator: np.random.Generator) -> Picture:
    """Returns a picture of two by two tiles with light joints."""
    rows, columns = _cells()
    half = SIZE // 2
    tile = rows // half * 2 + columns // half
    shade = 1 + generator.uniform(-0.03, 0.03, 4)[tile] + 0.03 * _noise(generator, 40, 25)
    is_joint = (rows % half < 3) | (columns % half < 3)
    return _paint((0.90, 0.90, 0.88), np.where(is_joint, 0.70, shade))


def _grass(generator: np.random.Generator) -> Picture:
    shade = 1 + 0.22 * _noise(generator, 1.5, 4) + 0.10 * _noise(generator, 40, 40)
    return _paint((0.33, 0.53, 0.22), shade)


def _asphalt(generator: np.random.Generator) -> Picture:
    shade = 1 + 0.14 * _noise(generator, 1.6, 1.6) + 0.05 * _noise(generator, 60, 60)
    return _paint((0.42, 0.42, 0.44), shade)


_PAINTERS: Final[dict[str, tuple[Callable[[np.random.Generator], Picture], tuple[float, float]]]] = {
    "asphalt": (_asphalt, (2.0, 2.0)),
    "brick": (_brick, (1.0, 0.6)),
    "carpet": (_carpet, (0.8, 0.8)),
    "checker": (_checker, (1.0, 1.0)),
    "grass": (_grass, (2.0, 2.0)),
    "tiles": (_tiles, (0.8, 0.8)),
    "wood": (_wood, (1.6, 0.64)),
}
