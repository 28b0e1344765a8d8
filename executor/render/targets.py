"""Framebuffers of the GL renderer, one of each size."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Size = tuple[int, int]


MOST_SIZES: Final = 6


class Targets:
    """Keeps the framebuffers of the most recently used sizes.

    With `samples` > 1 the hardware smooths edges.
    """

    def __init__(self, context: Any, samples: int) -> None:
        self._context = context
        self._samples = samples
        self._plain: dict[Size, Any] = {}
        self._sampled: dict[Size, Any] = {}
        self._measured: dict[Size, Any] = {}
        self._drawn: Any = None

    def picture(self, width: int, height: int, *, smooth: bool) -> Any:
        """Returns the framebuffer to draw a picture into."""
        size = (width, height)
        self._plain[size] = self._plain.pop(size, None) or self._colored(size, 0)
        target = self._plain[size]
        if smooth and self._samples > 1:
            target = self._sampled.pop(size, None) or self._colored(size, self._samples)
            self._sampled[size] = target
        self._drawn = target
        for kept in (self._plain, self._sampled):
            _forget_oldest(kept)
        return target

    def read(
        self, width: int, height: int, *, of: Size | None = None, at: Size = (0, 0)
    ) -> NDArray[np.uint8]:
        """Returns the last picture as rows of RGBA.

        With `of` and `at`, returns a part of a picture of the size `of`.
        """
        plain = self._plain[of or (width, height)]
        if self._drawn is not plain:
            self._context.copy_framebuffer(plain, self._drawn)
        picture = np.empty((height, width, 4), np.uint8)
        plain.read_into(picture, viewport=(*at, width, height), components=4)
        return picture

    def measured(self, width: int, height: int) -> Any:
        """Returns the framebuffer for depth and object: two floats for each pixel."""
        size = (width, height)
        target = self._measured.pop(size, None)
        if target is None:
            values = self._context.renderbuffer(size, 2, dtype="f4")
            target = self._context.framebuffer([values], self._context.depth_renderbuffer(size))
        self._measured[size] = target
        _forget_oldest(self._measured)
        return target

    def _colored(self, size: Size, samples: int) -> Any:
        color = self._context.renderbuffer(size, 4, samples=samples)
        depth = self._context.depth_renderbuffer(size, samples=samples)
        return self._context.framebuffer([color], depth)


def _forget_oldest(kept: dict[Size, Any]) -> None:
    """Drops the oldest framebuffer if there are too many; clients choose the sizes of their pictures."""
    while len(kept) > MOST_SIZES:
        target = kept.pop(next(iter(kept)))
        for attachment in (*target.color_attachments, target.depth_attachment):
            attachment.release()
        target.release()
