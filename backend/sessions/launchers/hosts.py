"""Runs executors in containers of several hosts: of this one, and of those that the settings name.

A session is started where most places are free. It is tried on the next host only if the one before has
refused it, or was not reached at all: a request whose answer was lost may have started an executor.
"""

from __future__ import annotations

import logging
import threading
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final, TypeVar

from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.hosts.contact import LOST_S, Contact
from backend.sessions.launchers.base import UNKNOWN_EXIT, Launcher, News, Spec, Started, State
from backend.sessions.launchers.docker import KeeperUnreachedError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from backend.sessions.launchers.docker import DockerLauncher, Room

__all__ = ["HostsLauncher", "lost_reason"]

log = logging.getLogger(__name__)

LOCAL: Final = ""
"""The name of the host of the web server itself."""
Answer = TypeVar("Answer")


def lost_reason(host: str) -> str:
    """Returns the text that explains the end of a session whose host is lost."""
    return f"The host {host} was not reached for {LOST_S:g} s, so its robots were given up."


class HostsLauncher(Launcher):
    """Starts executors through the keepers of several hosts.

    Args:
        hosts: the launcher of each host; that of this machine has the name "".
    """

    name = "docker"
    survives_server = True

    def __init__(
        self, hosts: Mapping[str, DockerLauncher], clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._hosts = dict(hosts)
        self._clock = clock
        self._contacts = {name: Contact() for name in hosts if name != LOCAL}
        self._placing: Counter[str] = Counter()
        self._lock = threading.Lock()
        self._threads = ThreadPoolExecutor(4 * len(self._hosts), thread_name_prefix="hosts")

    def start(self, spec: Spec) -> Started:
        """Starts a container where most places are free."""
        refusals: list[HostFullError] = []
        tried: set[str] = set()
        while True:
            with self._place(tried, lambda room: room.free) as name:
                if name is None:
                    break
                tried.add(name)
                try:
                    started = self._hosts[name].start(spec)
                except HostFullError as error:
                    refusals.append(error)
                except KeeperUnreachedError as error:
                    log.warning("%s", error.detail)
                else:
                    return replace(started, state={**started.state, "host": name}, host=name)
        if refusals:
            raise HostFullError("The places of all hosts are taken.")
        raise LaunchError("No keeper of executors answers, on any host.")

    def open_tools(self, tools_id: str, token: str, *, timeout_s: float) -> str:
        """Returns the address at which a user's tools listen: where they run, else where most is free."""
        runs = self._ask_all(lambda launcher: launcher.has_tools(tools_id))
        found = next((name for name, has_them in runs.items() if has_them), None)
        if found is not None:
            return self._hosts[found].open_tools(tools_id, token, timeout_s=timeout_s)
        refusals: list[HostFullError] = []
        tried: set[str] = set()
        while True:
            with self._place(tried, lambda room: room.free_tools) as name:
                if name is None:
                    break
                tried.add(name)
                try:
                    return self._hosts[name].open_tools(tools_id, token, timeout_s=timeout_s)
                except HostFullError as error:
                    refusals.append(error)
                except KeeperUnreachedError as error:
                    log.warning("%s", error.detail)
        if refusals:
            raise refusals[0]
        raise LaunchError("No keeper of executors answers, on any host.")

    def poll(self, state: State) -> int | None:
        """Returns the keeper's answer. While a host is not reached, its executors count as running."""
        launcher = self._of(state)
        return UNKNOWN_EXIT if launcher is None else launcher.poll(state)

    def explain(self, state: State) -> str:
        """Returns the reason why an executor ended, if more is known than its status; otherwise ""."""
        launcher = self._of(state)
        if launcher is None:
            return f"Its host {state['host']} is not in BT_STUDIO_EXECUTOR_HOSTS any more."
        return launcher.explain(state)

    def stop(self, state: State, *, timeout_s: float) -> None:
        """Ends the container; on a host that is not reached, this follows when it is."""
        launcher = self._of(state)
        if launcher is not None:
            launcher.stop(state, timeout_s=timeout_s)

    def running(self) -> list[str]:
        """Returns the ids of the sessions whose containers run, on all hosts."""
        return [made_id for found in self._ask_all(lambda one: one.running()).values() for made_id in found]

    def state_of(self, session_id: str) -> dict[str, Any]:
        """Asks all hosts for a session; returns the state of a local one if none knows it."""
        state = {"session": session_id}
        knows = self._ask_all(lambda launcher: launcher.knows(session_id))
        return state | {"host": next((name for name, does in knows.items() if does), LOCAL)}

    def is_reached(self, state: State) -> bool:
        """Returns whether the host of an executor answers now."""
        name = state.get("host", LOCAL)
        return name == LOCAL or name not in self._hosts or self._room(name) is not None

    def look_at_hosts(self) -> News:
        """Asks all further hosts for a sign of life, which is one of this server for them, too."""
        looks = {name: self._threads.submit(self._hosts[name].greet) for name in self._contacts}
        has_returned = False
        for name, look in looks.items():
            contact = self._contacts[name]
            try:
                look.result()
            except LaunchError as error:
                was_lost = contact.is_lost
                contact.missed(self._clock())
                if contact.is_lost and not was_lost:
                    log.warning("the host %s is lost: %s", name, error.detail)
            else:
                if contact.heard(self._clock()):
                    log.warning("the host %s answers again", name)
                    has_returned = True
        lost = {name: lost_reason(name) for name, contact in self._contacts.items() if contact.is_lost}
        return News(lost, has_returned)

    def rooms(self) -> dict[str, Room | None]:
        """Returns the places of each host; None for one that is not reached."""
        asked = {name: self._threads.submit(self._room, name) for name in self._hosts}
        return {name: room.result() for name, room in asked.items()}

    def close(self) -> None:
        """Ends the threads; executors stay."""
        self._threads.shutdown()

    @contextmanager
    def _place(self, tried: set[str], free: Callable[[Room], int]) -> Iterator[str | None]:
        """Yields the host with most places; meanwhile one of them counts as taken on this server."""
        rooms = {name: room for name, room in self.rooms().items() if room is not None and name not in tried}
        with self._lock:
            # `max` keeps the first of equals, which is this machine.
            name = max(rooms, key=lambda one: free(rooms[one]) - self._placing[one], default=None)
            if name is not None:
                self._placing[name] += 1
        try:
            yield name
        finally:
            if name is not None:
                with self._lock:
                    self._placing[name] -= 1

    def _room(self, name: str) -> Room | None:
        try:
            return self._hosts[name].room()
        except LaunchError:
            return None

    def _ask_all(self, question: Callable[[DockerLauncher], Answer]) -> dict[str, Answer]:
        asked = {name: self._threads.submit(question, launcher) for name, launcher in self._hosts.items()}
        return {name: answer.result() for name, answer in asked.items()}

    def _of(self, state: State) -> DockerLauncher | None:
        return self._hosts.get(state.get("host", LOCAL))
