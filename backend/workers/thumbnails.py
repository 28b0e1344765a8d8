"""Small pictures of runs: a camera picture, else a drawing of the world with the robot's path or of the tree.

The input was written by an untrusted process. So a picture is decoded within bounds and encoded again, and a
drawing is made of numbers alone.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

__all__ = ["thumbnail"]

WIDTH: Final = 320
HEIGHT: Final = 200
LARGEST_M: Final = 50.0  # half of a body; a larger one is a ground, and not the world
MOST_PIXELS: Final = 4096 * 4096
QUALITY: Final = 75
_COLORS: Final = ("#868e96", "#f59f00", "#2f9e44", "#e03131", "#868e96")
_BODY: Final = "#868e96"
_TRAIL: Final = "#228be6"
_ROW: Final = 14
_MARGIN: Final = 12


def thumbnail(
    picture: bytes,
    boxes: Sequence[Sequence[float]],
    trail: Sequence[Sequence[float]],
    rows: Sequence[Sequence[int]],
) -> dict[str, Any]:
    """Returns `type` and `data` of a picture that a browser shows; an empty type if there is nothing to show.

    Args:
        picture: a JPEG picture, or nothing.
        boxes: bodies as [x, y, half length, half width, angle, is round], in m.
        trail: the way of the robot, in m.
        rows: the nodes of the tree: depth and status.
    """
    if picture and (small := _smaller(picture)):
        return {"type": "image/jpeg", "data": small}
    drawn = _world(boxes, trail) if trail else _tree(rows)
    return {"type": "image/svg+xml" if drawn else "", "data": drawn.encode()}


def _smaller(picture: bytes) -> bytes:
    """Returns a JPEG picture in the size of a thumbnail; nothing if it cannot be decoded."""
    import numpy as np  # noqa: PLC0415 - keeps the start of a worker short
    import simplejpeg  # noqa: PLC0415 - as above

    try:
        height, width, _, _ = simplejpeg.decode_jpeg_header(picture)
        if not 0 < height * width <= MOST_PIXELS:
            return b""
        pixels = simplejpeg.decode_jpeg(picture, "RGB", fastdct=True)
    except (ValueError, RuntimeError):
        return b""
    step = max(1, -(-height // HEIGHT), -(-width // WIDTH))
    return bytes(simplejpeg.encode_jpeg(np.ascontiguousarray(_averaged(pixels, step)), QUALITY, "RGB"))


def _averaged(pixels: NDArray[np.uint8], step: int) -> NDArray[np.uint8]:
    """Returns the means of squares of `step` pixels; incomplete squares at two edges are cut off."""
    height, width = max(1, pixels.shape[0] // step), max(1, pixels.shape[1] // step)
    whole = pixels[: height * step, : width * step]
    if whole.shape[:2] != (height * step, width * step):
        return pixels[::step, ::step]  # a strip that is narrower than a square
    means = whole.reshape(height, step, width, step, 3).mean(axis=(1, 3))
    small: NDArray[np.uint8] = means.astype("uint8")
    return small


def _world(boxes: Sequence[Sequence[float]], trail: Sequence[Sequence[float]]) -> str:
    corners = [(x, y) for x, y in trail]
    for x, y, half_x, half_y, angle, _ in boxes:
        if max(half_x, half_y) < LARGEST_M:
            along, across = abs(math.cos(angle)), abs(math.sin(angle))
            wide, high = half_x * along + half_y * across, half_x * across + half_y * along
            corners += [(x - wide, y - high), (x + wide, y + high)]
    left, right = min(x for x, _ in corners), max(x for x, _ in corners)
    low, high = min(y for _, y in corners), max(y for _, y in corners)
    scale = min((WIDTH - 2 * _MARGIN) / max(right - left, 0.5), (HEIGHT - 2 * _MARGIN) / max(high - low, 0.5))
    middle_x, middle_y = (left + right) / 2, (low + high) / 2

    def at(x: float, y: float) -> tuple[float, float]:
        return WIDTH / 2 + (x - middle_x) * scale, HEIGHT / 2 - (y - middle_y) * scale

    parts = []
    for x, y, half_x, half_y, angle, is_round in boxes:
        across, up = at(x, y)
        size_x, size_y = max(half_x * scale, 0.5), max(half_y * scale, 0.5)
        if is_round:
            parts.append(f'<circle cx="{across:.1f}" cy="{up:.1f}" r="{size_x:.1f}"/>')
        else:
            turn = f"rotate({-math.degrees(angle):.1f} {across:.1f} {up:.1f})"
            parts.append(
                f'<rect x="{across - size_x:.1f}" y="{up - size_y:.1f}" width="{2 * size_x:.1f}" '
                f'height="{2 * size_y:.1f}" transform="{turn}"/>'
            )
    points = " ".join(f"{across:.1f},{up:.1f}" for across, up in (at(x, y) for x, y in trail))
    across, up = at(*trail[-1])
    return _svg(
        f'<g fill="{_BODY}" fill-opacity="0.6">{"".join(parts)}</g>'
        f'<polyline points="{points}" fill="none" stroke="{_TRAIL}" stroke-width="3"/>'
        f'<circle cx="{across:.1f}" cy="{up:.1f}" r="6" fill="{_TRAIL}"/>'
    )


def _tree(rows: Sequence[Sequence[int]]) -> str:
    shown = rows[: (HEIGHT - _MARGIN) // _ROW]
    if not shown:
        return ""
    parts = []
    for place, (depth, status) in enumerate(shown):
        x = _MARGIN + min(depth, 12) * 16
        color = _COLORS[status] if 0 <= status < len(_COLORS) else _BODY
        y = _MARGIN // 2 + place * _ROW
        parts.append(f'<rect x="{x}" y="{y}" width="96" height="10" rx="3" fill="{color}"/>')
    return _svg("".join(parts))


def _svg(inside: str) -> str:
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}">{inside}</svg>'
