"""Makes walls of an occupancy map of `nav2_map_server`: `map.yaml` with a PGM or PNG picture."""

from __future__ import annotations

import math
import posixpath
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, TypeGuard

import numpy as np

from executor.imports.worlds import Imported, to_yaml
from executor.universes.document import DocumentError, Problem, read_yaml
from executor.universes.loader import UniverseError, parse_universe
from executor.world.geometry.transforms import compose, from_xyz_rpy, to_xyz_rpy

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.sdf.files import Files

HEIGHT_M: Final = 1.0
MOST_WALLS: Final = 2_000
MOST_PIXELS: Final = 25_000_000
MAX_BYTES: Final = 50_000_000
WALL_COLOR: Final = "#c8c4bc"
Rectangle = tuple[int, int, int, int]
"""First column, first row, columns, rows; rows count from below."""


@dataclass(frozen=True)
class Map:
    """The values of a map's file, in m and rad."""

    image: str
    resolution: float
    origin: tuple[float, float, float]
    negate: bool
    occupied: float
    line: int


def is_map(text: str) -> bool:
    """Returns whether a YAML document is a map rather than a universe."""
    try:
        value = read_yaml(text, as_ros=True).value
    except DocumentError:
        return False
    return isinstance(value, dict) and {"image", "resolution", "origin"} <= value.keys()


def import_map(data: bytes, file: str, files: Files) -> Imported:
    """Returns the universe whose walls are the occupied cells of a map.

    A map of more walls than a universe may have is read with coarser cells, which is said.

    Raises:
        UniverseError: the map or its picture cannot be read, or nothing in it is occupied.
    """
    shown = posixpath.basename(file.replace("\\", "/"))
    described = _read(data.decode("utf-8", "replace"), shown)
    cells = _occupied(described, _picture(described, file, files, shown))
    resolution, notes = described.resolution, []
    found = rectangles(cells)
    while len(found) > MOST_WALLS:
        cells = _coarser(cells)
        resolution *= 2
        found = rectangles(cells)
    if not found:
        raise UniverseError([Problem("no cell of the map is occupied", described.line, code="BTU005")], shown)
    if resolution != described.resolution:
        text = f"the map has more than {MOST_WALLS} walls: its cells are {resolution:g} m here"
        notes.append(Problem(text, described.line, code="BTU006"))
    document: dict[str, Any] = {
        "format": "bt-studio/universe",
        "version": 1,
        "name": (shown.rpartition(".")[0] or shown)[:120],
        "description": f"Walls of the map {shown}.",
        "models": [_wall(number, cell, resolution, described) for number, cell in enumerate(found, 1)],
    }
    text = to_yaml(document)
    parse_universe(text, shown)
    return Imported(text, notes, {}, len(found))


def rectangles(cells: NDArray[np.bool_]) -> list[Rectangle]:
    """Returns rectangles that cover the true cells, each once: rows of equal runs are joined."""
    made: list[Rectangle] = []
    growing: dict[tuple[int, int], tuple[int, int]] = {}
    for row, line in enumerate([*cells, np.zeros(cells.shape[1], bool)]):
        edges = np.flatnonzero(np.diff(np.concatenate([[0], line.astype(np.int8), [0]])))
        runs = {(int(a), int(b)) for a, b in edges.reshape(-1, 2)}
        for run in sorted(growing.keys() - runs):
            first, count = growing.pop(run)
            made.append((run[0], first, run[1] - run[0], count))
        for run in runs:
            first, count = growing.get(run, (row, 0))
            growing[run] = (first, count + 1)
    return made


def _wall(number: int, cell: Rectangle, resolution: float, described: Map) -> dict[str, Any]:
    column, row, columns, rows = cell
    x, y, yaw = described.origin
    middle = ((column + columns / 2) * resolution, (row + rows / 2) * resolution, HEIGHT_M / 2)
    pose = compose(from_xyz_rpy((x, y, 0, 0, 0, yaw)), (*middle, 0.0, 0.0, 0.0, 1.0))
    return {
        "id": f"wall_{number}",
        "shape": "box",
        "size": [round(columns * resolution, 6), round(rows * resolution, 6), HEIGHT_M],
        "pose": [round(value, 6) + 0.0 for value in to_xyz_rpy(pose)],
        "color": WALL_COLOR,
    }


def _read(text: str, file: str) -> Map:
    try:
        document = read_yaml(text, file, as_ros=True)
    except DocumentError as error:
        raise UniverseError(error.problems, file) from error
    value = document.value

    def wrong(key: str, what: str) -> UniverseError:
        line, column = document.place((key,))
        return UniverseError([Problem(f"`{key}` of a map is {what}", line, column, "BTU005")], file)

    if not isinstance(value, dict) or not isinstance(value.get("image"), str) or not value["image"]:
        raise wrong("image", "the name of a picture")
    resolution, occupied = value.get("resolution"), value.get("occupied_thresh", 0.65)
    if not _is_number(resolution) or not 1e-4 <= resolution <= 100:
        raise wrong("resolution", "the size of a cell in m")
    origin = value.get("origin")
    if not isinstance(origin, list) or len(origin) not in (2, 3) or not all(map(_is_number, origin)):
        raise wrong("origin", "[x, y, yaw] of its lower left corner")
    if not _is_number(occupied) or not 0 <= occupied <= 1:
        raise wrong("occupied_thresh", "a number from 0 to 1")
    x, y, yaw = (*map(float, origin), 0.0)[:3]
    negate = value.get("negate", 0) in (1, True, "1", "true")
    line = document.place(("image",))[0]
    return Map(value["image"], float(resolution), (x, y, yaw), negate, float(occupied), line)


def _is_number(value: object) -> TypeGuard[float]:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _picture(described: Map, file: str, files: Files, shown: str) -> NDArray[np.uint8]:
    import cv2  # noqa: PLC0415 - slow to load

    from tree_gardener.packages import PackageError  # noqa: PLC0415 - beside its only use

    def wrong(reason: str) -> UniverseError:
        text = f"the picture {described.image} cannot be read: {reason}"
        return UniverseError([Problem(text, described.line, code="BTU005")], shown)

    try:
        data = files.read(files.find(described.image, file))
    except PackageError as error:
        raise wrong(str(error)) from error
    if data is None:
        raise wrong("there is no such file beside the map")
    if not data or len(data) > MAX_BYTES:
        raise wrong(f"it is empty, or larger than {MAX_BYTES // 1_000_000} MB")
    if data.startswith(b"P2"):
        data += b"\n"  # OpenCV reads past the last number
    try:
        picture = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error:
        picture = None
    if picture is None or picture.size == 0:
        raise wrong("it is no PGM or PNG")
    if picture.shape[0] * picture.shape[1] > MOST_PIXELS:
        raise wrong(f"it has more than {MOST_PIXELS} pixels")
    white = _white(data, picture)
    if white != 255:
        picture = np.minimum(picture / white * 255, 255).astype(np.uint8)
    if picture.ndim == 3:
        opaque = picture[:, :, 3] > 0 if picture.shape[2] == 4 else np.ones(picture.shape[:2], bool)
        shade = picture[:, :, :3].mean(axis=2)
        picture = np.where(opaque, shade, 205).astype(np.uint8)  # what is transparent is unknown
    return np.asarray(picture, np.uint8)


def _white(data: bytes, picture: NDArray[Any]) -> int:
    """Returns the value that white has in a decoded picture.

    A PGM names it. OpenCV applies what a PGM of 8 bits in text names, and no other (findings/ shows it);
    `nav2_map_server` applies all.
    """
    header = re.match(rb"(P[25])(?:\s+(?:#[^\n]*\n\s*)*(\d+)){3}", data)
    if header is None:
        return int(np.iinfo(picture.dtype).max)
    white = int(header[2])
    return 255 if header[1] == b"P2" and white <= 255 else max(white, 1)


def _occupied(described: Map, picture: NDArray[np.uint8]) -> NDArray[np.bool_]:
    shade = picture.astype(np.float64) / 255
    chance = shade if described.negate else 1 - shade
    return np.asarray(chance[::-1] > described.occupied)  # the last row of the picture is the lowest


def _coarser(cells: NDArray[np.bool_]) -> NDArray[np.bool_]:
    rows, columns = (size + size % 2 for size in cells.shape)
    whole = np.zeros((rows, columns), bool)
    whole[: cells.shape[0], : cells.shape[1]] = cells
    return np.asarray(whole.reshape(rows // 2, 2, columns // 2, 2).any(axis=(1, 3)))
