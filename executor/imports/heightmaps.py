"""Makes a mesh of a `<heightmap>`."""

from __future__ import annotations

import posixpath
from typing import TYPE_CHECKING, Final

import numpy as np

from executor.sdf.includes import file_of
from executor.sdf.values import numbers, text_of
from tree_gardener.packages import PackageError

if TYPE_CHECKING:
    from collections.abc import Callable

    from lxml import etree
    from numpy.typing import NDArray

    from executor.sdf.files import Files

MOST_SAMPLES: Final = 257
"""Along each side; a picture of more pixels is made smaller."""
MAX_BYTES: Final = 20_000_000


def heightmap_mesh(
    shape: etree._Element, files: Files, skip: Callable[[etree._Element, str], None]
) -> tuple[NDArray[np.float64], NDArray[np.int64]] | None:
    """Returns points and triangles of a heightmap in its frame; None if it is left out."""
    uri = text_of(shape, "uri")
    file = file_of(shape)
    try:
        if not uri:
            raise PackageError("it names no picture")
        path = files.find(uri, file)
    except PackageError as error:
        skip(shape, f"the <heightmap> {uri or 'without a uri'} is left out: {error}")
        return None
    data = files.read(path)
    heights = None if data is None or len(data) > MAX_BYTES else _picture(data)
    if heights is None:
        skip(
            shape, f"the <heightmap> {uri} is left out: {posixpath.basename(path)} is no picture that is read"
        )
        return None
    if max(heights.shape) > MOST_SAMPLES:
        skip(shape, f"the <heightmap> {uri} has {MOST_SAMPLES} samples along a side here")
        heights = _smaller(heights)
    size, middle = numbers(shape, "size", 3, file), numbers(shape, "pos", 3, file)
    rows, columns = heights.shape
    x = np.linspace(-0.5, 0.5, columns) * size[0]
    y = np.linspace(0.5, -0.5, rows) * size[1]  # the first row of the picture is the north
    grid = np.stack([*np.meshgrid(x, y), heights * size[2]], axis=-1).reshape(-1, 3) + middle
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    lower = np.stack([corner, corner + columns, corner + 1], axis=1)
    upper = np.stack([corner + 1, corner + columns, corner + columns + 1], axis=1)
    return grid, np.concatenate([lower, upper]).astype(np.int64)


def _picture(data: bytes) -> NDArray[np.float64] | None:
    import cv2  # noqa: PLC0415 - slow to load

    if not data:
        return None
    try:
        found = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_GRAYSCALE | cv2.IMREAD_ANYDEPTH)
    except cv2.error:
        return None
    if found is None or min(found.shape) < 2:
        return None
    most = float(np.iinfo(found.dtype).max) if found.dtype.kind == "u" else 1.0
    return np.asarray(found, np.float64) / most


def _smaller(heights: NDArray[np.float64]) -> NDArray[np.float64]:
    rows, columns = (np.linspace(0, n - 1, min(n, MOST_SAMPLES)).round().astype(int) for n in heights.shape)
    return np.asarray(heights[np.ix_(rows, columns)], np.float64)
