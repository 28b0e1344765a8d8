"""What the GL renderer draws into and reads from, one of each size."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Size = tuple[int, int]


class Targets:
    """Framebuffers by size. With `samples` > 1 the hardware smooths the edges."""

    def __init__(self, context: Any, samples: int) -> None:
        self._context = context
        self._samples = samples
        self._plain: dict[Size, Any] = {}
        self._sampled: dict[Size, Any] = {}
        self._measured: dict[Size, Any] = {}
        self._pending: dict[Size, Any] = {}

    def picture(self, width: int, height: int, *, smooth: bool) -> Any:
        """Returns the framebuffer to draw a picture into."""
        size = (width, height)
        if size not in self._plain:
            self._plain[size] = self._colored(size, 0)
        target = self._plain[size]
        if smooth and self._samples > 1:
            if size not in self._sampled:
                self._sampled[size] = self._colored(size, self._samples)
            target = self._sampled[size]
        self._pending[size] = target
        return target

    def read(self, width: int, height: int) -> NDArray[np.uint8]:
        """Returns what was drawn into `picture` last, as rows of RGBA."""
        size = (width, height)
        target, plain = self._pending[size], self._plain[size]
        if target is not plain:
            self._context.copy_framebuffer(plain, target)
        picture = np.empty((height, width, 4), np.uint8)
        plain.read_into(picture, components=4)
        return picture

    def measured(self, width: int, height: int) -> Any:
        """Returns the framebuffer for two floats a pixel."""
        size = (width, height)
        if size not in self._measured:
            values = self._context.renderbuffer(size, 2, dtype="f4")
            depth = self._context.depth_renderbuffer(size)
            self._measured[size] = self._context.framebuffer([values], depth)
        return self._measured[size]

    def _colored(self, size: Size, samples: int) -> Any:
        color = self._context.renderbuffer(size, 4, samples=samples)
        depth = self._context.depth_renderbuffer(size, samples=samples)
        return self._context.framebuffer([color], depth)
