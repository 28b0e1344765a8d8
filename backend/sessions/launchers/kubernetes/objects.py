"""Knows all pods, or all RayJobs, that we made: a thread lists them, then watches what changes.

No call waits for the cluster but `wait`. While it does not answer, what was known last holds. A watch that is
too old (410 Gone) or broken begins again with a list, which also shows which were deleted meanwhile.
"""

from __future__ import annotations

import logging
from collections import OrderedDict
from dataclasses import replace
from threading import Condition, Event, Thread
from time import monotonic
from typing import TYPE_CHECKING, Any, Final

import httpx2
import msgspec
from lightkube.core.decoders import ListMetadata, WatchEvent
from lightkube.models.meta_v1 import Status

from backend.sessions.launchers.base import UNKNOWN_EXIT
from backend.sessions.launchers.kubernetes.bodies import KIND_LABEL
from backend.sessions.launchers.kubernetes.ends import Cause, Seen, Trouble

if TYPE_CHECKING:
    from collections.abc import Callable

    from lightkube import Client

__all__ = ["Objects", "decided", "is_over"]

log = logging.getLogger(__name__)

WATCH_S: Final = 240
FIRST_PAUSE_S: Final = 0.2
LONGEST_PAUSE_S: Final = 10.0
CLOSE_S: Final = 5.0
MOST_ENDED: Final = 2000
"""Number of deleted objects whose ends are remembered."""
UNKNOWN_S: Final = 15.0
"""How long an object of which nothing is known counts as running."""
# An answer that is no JSON is a ValueError, a client that was closed a RuntimeError.
_BROKEN: Final = (httpx2.HTTPError, OSError, ValueError, RuntimeError)

for _kind in (ListMetadata, Status):
    msgspec.convert({}, _kind)  # msgspec does not end if two threads meet a type for the first time
msgspec.json.decode(b'{"type": "ADDED", "object": {}}', type=WatchEvent)


class Objects:
    """The objects of a kind with our label, in the namespace of a client. `close` ends its thread.

    Args:
        client: the client; it is closed with this.
        resource: the kind, as lightkube knows it.
        read: returns what an object says of itself.
    """

    def __init__(self, client: Client, resource: type[Any], read: Callable[[Any], Seen]) -> None:
        self._client = client
        self._resource = resource
        self._read = read
        self._unknown_since: dict[str, float] = {}
        self._living: dict[str, Seen] = {}
        self._ended: OrderedDict[str, Seen] = OrderedDict()
        self._changed = Condition()
        self._is_listed = False
        self._closing = Event()
        self._thread = Thread(target=self._run, name=f"kubernetes {resource.__name__}", daemon=True)
        self._thread.start()

    def get(self, name: str) -> Seen | None:
        """Returns what is known of an object; None if there is none, or not known yet. Never waits."""
        with self._changed:
            return self._living.get(name) or self._ended.get(name)

    def poll(self, name: str) -> int | None:
        """Returns how an object ended; None while it runs, or while the cluster does not answer."""
        seen = self.get(name)
        if seen is not None:
            self._unknown_since.pop(name, None)
            return seen.exit_status
        if not self.are_listed:
            return None
        # Another web server may have made it just now.
        since_s = self._unknown_since.setdefault(name, monotonic())
        return UNKNOWN_EXIT if monotonic() - since_s > UNKNOWN_S else None

    def explain(self, name: str) -> str:
        """Returns the reason why an object ended, if more is known than its status; otherwise ""."""
        seen = self.get(name)
        return seen.trouble.text if seen and seen.trouble else ""

    @property
    def are_listed(self) -> bool:
        """Whether the objects that existed at the start are known."""
        return self._is_listed

    def wait(
        self, name: str, condition: Callable[[Seen | None], bool], deadline_s: float
    ) -> tuple[Seen | None, bool]:
        """Waits until what is known of an object fulfils a condition.

        Args:
            name: its name.
            condition: is called with what is known, at once and after each change.
            deadline_s: the time of `time.monotonic` up to which it waits.

        Returns what is known, and whether it fulfils the condition.
        """
        with self._changed:
            while True:
                seen = self._living.get(name) or self._ended.get(name)
                if condition(seen):
                    return seen, True
                left_s = deadline_s - monotonic()
                if left_s <= 0 or self._closing.is_set():
                    return seen, False
                self._changed.wait(left_s)

    def wait_until_gone(self, name: str, deadline_s: float) -> bool:
        """Waits until no object of a name is known, also none that has ended; returns whether that is so."""
        with self._changed:
            left_s = max(0.0, deadline_s - monotonic())
            return self._changed.wait_for(lambda: name not in self._living, left_s)

    def close(self) -> None:
        """Ends the thread, all waits, and the connections of the client."""
        self._closing.set()
        with self._changed:
            self._changed.notify_all()
        self._client.close()
        self._thread.join(CLOSE_S)

    def _run(self) -> None:
        pause_s = FIRST_PAUSE_S
        while not self._closing.is_set():
            try:
                version = self._list()
                pause_s = FIRST_PAUSE_S
                self._watch(version)
            except _BROKEN as error:
                log.info("the watch over %s begins again: %s", self._resource.__name__, error)
            self._closing.wait(pause_s)
            pause_s = min(LONGEST_PAUSE_S, 2 * pause_s)

    def _list(self) -> str:
        listed = self._client.list(self._resource, labels={KIND_LABEL: None}, chunk_size=500)
        found = {each.metadata.name or "": self._read(each) for each in listed if each.metadata}
        with self._changed:
            for name in self._living.keys() - found.keys():
                self._note_end(name)
            self._living |= found
            self._is_listed = True
            self._changed.notify_all()
        return str(listed.resourceVersion)

    def _watch(self, version: str) -> None:
        for kind, found in self._client.watch(
            self._resource, labels={KIND_LABEL: None}, server_timeout=WATCH_S, resource_version=version
        ):
            if self._closing.is_set():
                return
            if not found.metadata or not found.metadata.name:
                continue
            with self._changed:
                self._living[found.metadata.name] = self._read(found)
                if kind == "DELETED":
                    self._note_end(found.metadata.name)
                self._changed.notify_all()

    def _note_end(self, name: str) -> None:
        seen = self._living.pop(name)
        if seen.exit_status is None:
            trouble = seen.trouble or Trouble(Cause.DELETED)
            seen = replace(seen, is_ready=False, exit_status=UNKNOWN_EXIT, trouble=trouble)
        self._ended[name] = seen
        while len(self._ended) > MOST_ENDED:
            self._ended.popitem(last=False)


def decided(uid: str) -> Callable[[Seen | None], bool]:
    """Returns a condition: it is known whether the object with this uid is ready."""
    return lambda seen: seen is not None and seen.uid == uid and seen.is_decided


def is_over(seen: Seen | None) -> bool:
    """Whether an object is gone, or has ended."""
    return seen is None or seen.exit_status is not None
