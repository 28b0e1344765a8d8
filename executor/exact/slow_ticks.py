"""Reports once that the world waits for an action whose tick takes long."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.child_messages import Log

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

    from executor.child_messages import Place

__all__ = ["SlowTicks"]


class SlowTicks:
    """Finds the action of a slow tick where the process looks for the place of its main thread anyway.

    The process looks once the main thread has not continued for half a second. Called on another thread.

    Args:
        locate: returns the place of a frame of the main thread.
        is_ticking: whether the tree ticks now, and nobody holds it.
        send: is called with the line.
    """

    def __init__(
        self,
        locate: Callable[[FrameType | None], Place],
        is_ticking: Callable[[], bool],
        send: Callable[[Log], None],
    ) -> None:
        self._locate = locate
        self._is_ticking = is_ticking
        self._send = send
        self._is_told = False

    def __call__(self, frame: FrameType | None) -> Place:
        """Returns the place of a frame."""
        place = self._locate(frame)
        if not self._is_told and (place.node_path or place.file) and self._is_ticking():
            self._is_told = True
            text = f"The world waits for {place.text}; Delay or RUNNING lets it move."
            self._send(Log("warning", text, place.node_id, place.node_path, of_world=True))
        return place
