"""Queues of the messages for one client. Both are bounded, even if the client is slow."""

from __future__ import annotations

import asyncio
from collections import deque
from typing import TYPE_CHECKING, Final

from executor.stream.frames import supersede

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["ControlOutbox", "StreamOutbox"]

MAX_MESSAGES: Final = 4000
MAX_BYTES: Final = 16 << 20
# Answers are never dropped. Beyond this number of unread answers, the client's commands are not handled.
MAX_REPLIES: Final = 10_000
PICTURES: Final = ("camera", "view")
PACE_S: Final = 0.5
RECORDING: Final = "recording/"
MOST_PARTS: Final = 16


class ControlOutbox:
    """A queue of messages in order. If the client is too slow, a new snapshot replaces the waiting messages.

    Args:
        snapshot: makes the bytes of a snapshot message.
    """

    def __init__(self, snapshot: Callable[[], bytes]) -> None:
        self._snapshot = snapshot
        self._messages: deque[tuple[bytes, bool]] = deque()
        self._events = 0
        self._event_bytes = 0
        self._needs_snapshot = False
        self._filled = asyncio.Event()
        self._room = asyncio.Event()
        self._room.set()

    def put(self, data: bytes, *, is_reply: bool) -> None:
        """Queues a message; replies are never dropped."""
        if is_reply:
            self._messages.append((data, True))
            if len(self._messages) - self._events >= MAX_REPLIES:
                self._room.clear()
        else:
            if self._events >= MAX_MESSAGES or self._event_bytes + len(data) > MAX_BYTES:
                self._drop_backlog()
            if not self._needs_snapshot:
                self._messages.append((data, False))
                self._events += 1
                self._event_bytes += len(data)
        self._filled.set()

    async def has_room(self) -> None:
        """Waits until the client has read some of its replies, if too many of them are unread."""
        await self._room.wait()

    async def take(self) -> bytes:
        """Waits for the next message, and returns it."""
        await self._filled.wait()
        if self._messages:
            data, is_reply = self._messages.popleft()
            if not is_reply:
                self._events -= 1
                self._event_bytes -= len(data)
            elif len(self._messages) - self._events < MAX_REPLIES:
                self._room.set()
        else:
            self._needs_snapshot = False
            data = self._snapshot()
        if not self._messages and not self._needs_snapshot:
            self._filled.clear()
        return data

    def _drop_backlog(self) -> None:
        if self._events:
            self._messages = deque(m for m in self._messages if m[1])
        self._events = self._event_bytes = 0
        self._needs_snapshot = True


class StreamOutbox:
    """A queue of the latest frame of each stream. A scene is sent before poses that refer to it."""

    def __init__(self) -> None:
        self._pictures = self._lost = 0
        self._reported_s: float | None = None
        self._frames: dict[str, bytes] = {}
        self._filled = asyncio.Event()

    def put(self, stream: str, data: bytes) -> None:
        """Queues a frame; it replaces an unsent one of its stream."""
        if stream == "scene":
            self._frames.pop("poses", None)
        if stream.startswith(RECORDING) and self._is_full_of_recordings():
            return
        waiting = self._frames.get(stream)
        self._frames[stream] = data if waiting is None else supersede(waiting, data)
        if stream.partition("/")[0] in PICTURES:
            self._pictures += 1
            self._lost += waiting is not None
        self._filled.set()

    def _is_full_of_recordings(self) -> bool:
        """Whether a client has requested more of a recording than it reads; it must repeat the request."""
        return sum(stream.startswith(RECORDING) for stream in self._frames) >= MOST_PARTS

    def lost_share(self, now_s: float) -> float | None:
        """Returns the share of pictures that newer ones replaced, once in each `PACE_S`; otherwise None."""
        if not self._pictures or (self._reported_s is not None and now_s - self._reported_s < PACE_S):
            return None
        share = self._lost / self._pictures
        is_first, self._reported_s = self._reported_s is None, now_s
        self._pictures = self._lost = 0
        return None if is_first else share

    async def take(self) -> bytes:
        """Waits for a frame, and returns the oldest one, or a scene first."""
        await self._filled.wait()
        stream = "scene" if "scene" in self._frames else next(iter(self._frames))
        data = self._frames.pop(stream)
        if not self._frames:
            self._filled.clear()
        return data
