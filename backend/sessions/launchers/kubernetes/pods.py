"""Knows all pods of sessions and tools: a thread lists them, then watches what changes.

No call waits for the cluster but `wait`. While it does not answer, what was known last holds. A watch that is
too old (410 Gone) or broken begins again with a list, which also shows which pods were deleted meanwhile.
"""

from __future__ import annotations

import logging
from collections import OrderedDict
from dataclasses import replace
from threading import Condition, Event, Thread
from time import monotonic
from typing import TYPE_CHECKING, Final

import httpx2
from lightkube.resources.core_v1 import Pod

from backend.sessions.launchers.base import UNKNOWN_EXIT
from backend.sessions.launchers.kubernetes.bodies import KIND_LABEL
from backend.sessions.launchers.kubernetes.ends import Cause, Seen, Trouble, read_pod

if TYPE_CHECKING:
    from collections.abc import Callable

    from lightkube import Client

__all__ = ["Pods"]

log = logging.getLogger(__name__)

WATCH_S: Final = 240
FIRST_PAUSE_S: Final = 0.2
LONGEST_PAUSE_S: Final = 10.0
CLOSE_S: Final = 5.0
MOST_ENDED: Final = 2000
"""Number of deleted pods whose ends are remembered."""
# An answer that is no JSON is a ValueError, a client that was closed a RuntimeError.
_BROKEN: Final = (httpx2.HTTPError, OSError, ValueError, RuntimeError)


class Pods:
    """The pods of sessions and tools in the namespace of a client. `close` ends its thread."""

    def __init__(self, client: Client) -> None:
        self._client = client
        self._living: dict[str, Seen] = {}
        self._ended: OrderedDict[str, Seen] = OrderedDict()
        self._changed = Condition()
        self._is_listed = False
        self._closing = Event()
        self._thread = Thread(target=self._run, name="kubernetes pods", daemon=True)
        self._thread.start()

    def get(self, name: str) -> Seen | None:
        """Returns what is known of a pod; None if there is none, or if it is not known yet. Never waits."""
        with self._changed:
            return self._living.get(name) or self._ended.get(name)

    @property
    def are_listed(self) -> bool:
        """Whether the pods that existed at the start are known."""
        return self._is_listed

    def wait(
        self, name: str, condition: Callable[[Seen | None], bool], deadline_s: float
    ) -> tuple[Seen | None, bool]:
        """Waits until what is known of a pod fulfils a condition.

        Args:
            name: the name of the pod.
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
                log.info("the watch over the pods begins again: %s", error)
            self._closing.wait(pause_s)
            pause_s = min(LONGEST_PAUSE_S, 2 * pause_s)

    def _list(self) -> str:
        listed = self._client.list(Pod, labels={KIND_LABEL: None}, chunk_size=500)
        found = {pod.metadata.name or "": read_pod(pod) for pod in listed if pod.metadata}
        with self._changed:
            for name in self._living.keys() - found.keys():
                self._note_end(name)
            self._living |= found
            self._is_listed = True
            self._changed.notify_all()
        return listed.resourceVersion

    def _watch(self, version: str) -> None:
        for kind, pod in self._client.watch(
            Pod, labels={KIND_LABEL: None}, server_timeout=WATCH_S, resource_version=version
        ):
            if self._closing.is_set():
                return
            if not pod.metadata or not pod.metadata.name:
                continue
            with self._changed:
                self._living[pod.metadata.name] = read_pod(pod)
                if kind == "DELETED":
                    self._note_end(pod.metadata.name)
                self._changed.notify_all()

    def _note_end(self, name: str) -> None:
        seen = self._living.pop(name)
        if seen.exit_status is None:
            trouble = seen.trouble or Trouble(Cause.DELETED)
            seen = replace(seen, is_ready=False, exit_status=UNKNOWN_EXIT, trouble=trouble)
        self._ended[name] = seen
        while len(self._ended) > MOST_ENDED:
            self._ended.popitem(last=False)
