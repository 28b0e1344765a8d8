"""Runs each executor in a container, which the keeper starts; executors outlive the web server.

The web server never uses Docker directly. It sends the id and the token of a session to the keeper
(`backend/sessions/keeper`), and receives the path of the unix socket at which the manager listens.
"""

from __future__ import annotations

import http.client
import logging
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.hosts.dial import NotReachedError
from backend.sessions.keeper.unix_http import ask, read_json
from backend.sessions.launchers.base import UNKNOWN_EXIT, Launcher, Spec, Started, State

log = logging.getLogger(__name__)

FOLDER: Final = Path("/run/bt-studio-keeper")
FULL: Final = 429
NOT_FOUND: Final = 404
MARGIN_S: Final = 30.0
LOOK_TIMEOUT_S: Final = 5.0


class KeeperUnreachedError(LaunchError):
    """The keeper of a host was asked for nothing, since the host was not reached."""


@dataclass(frozen=True, slots=True)
class Room:
    """The places of a host: how many executors may run, and how many more executors and tools may start."""

    places: int
    free: int
    free_tools: int


class DockerLauncher(Launcher):
    """Starts and ends executors through the keeper.

    Args:
        folder: the folder that is shared with the keeper; it holds the sockets of the keeper and of the
            sessions.
    """

    name = "docker"
    survives_server = True

    def __init__(self, folder: Path = FOLDER) -> None:
        self._socket = str(folder / "keeper.sock")

    def start(self, spec: Spec) -> Started:
        """Starts a container, and waits until its manager has received its socket."""
        body = {
            "session": spec.session_id,
            "token": spec.token,
            "domain_id": spec.ros_domain_id,
            "timeout_s": spec.start_timeout_s,
        }
        status, answer = self._ask("POST", "/sessions", body, timeout_s=spec.start_timeout_s + MARGIN_S)
        _raise_for(status, answer)
        return Started(self.address_of(spec.session_id, answer), {"session": spec.session_id})

    def open_tools(self, tools_id: str, token: str, *, timeout_s: float) -> str:
        """Returns the address at which a user's tools listen; starts their container if necessary."""
        body = {"tools": tools_id, "token": token, "timeout_s": timeout_s}
        status, answer = self._ask("POST", "/tools", body, timeout_s=timeout_s + MARGIN_S)
        _raise_for(status, answer)
        return self.address_of(tools_id, answer)

    def poll(self, state: State) -> int | None:
        """Returns the keeper's answer. While the keeper does not answer, executors count as running."""
        status, answer = self._look(state)
        if status != 200 or answer.get("running"):
            return None
        found = answer.get("status")
        return UNKNOWN_EXIT if found is None else int(found)

    def explain(self, state: State) -> str:
        """Returns the reason why an executor ended, if more is known than its status; otherwise ""."""
        return str(self._look(state)[1].get("reason", ""))

    def stop(self, state: State, *, timeout_s: float) -> None:
        """Ends the container; if the keeper does not answer, `end_orphans` does so later."""
        target = f"/sessions/{state['session']}?timeout_s={timeout_s:g}"
        try:
            status, answer = self._ask("DELETE", target, timeout_s=timeout_s + MARGIN_S)
        except LaunchError as error:
            status, answer = error.status, {"detail": error.detail}
        if status >= 400:
            log.warning("session %s was not ended: %s", state["session"], _detail(answer))

    def running(self) -> list[str]:
        """Returns the ids of the sessions whose containers run."""
        try:
            status, answer = self._ask("GET", "/sessions", timeout_s=LOOK_TIMEOUT_S)
        except LaunchError:
            return []
        sessions = answer.get("sessions", []) if status == 200 else []
        return [one["session"] for one in sessions if one["running"]]

    def state_of(self, session_id: str) -> dict[str, Any]:
        """Returns the state by which an executor is found, from the id of its session."""
        return {"session": session_id}

    def knows(self, session_id: str) -> bool:
        """Returns whether the keeper has a container of a session, which may have ended."""
        status, answer = self._look({"session": session_id})
        return status == 200 and bool(answer.get("running") or answer.get("status") is not None)

    def has_tools(self, tools_id: str) -> bool:
        """Returns whether a user's tools run on this host; False if the keeper does not say."""
        try:
            status, answer = self._ask("GET", f"/tools/{tools_id}", timeout_s=LOOK_TIMEOUT_S)
        except LaunchError:
            return False
        return status == 200 and answer.get("running") is True

    def greet(self) -> None:
        """Asks the keeper for its sessions, by which it knows that they are maintained.

        Raises:
            LaunchError: the keeper does not answer.
        """
        status, answer = self._ask("GET", "/sessions", timeout_s=LOOK_TIMEOUT_S)
        _raise_for(status, answer)

    def room(self) -> Room:
        """Returns the places of the host; none if its keeper is of an older version, which does not say.

        Raises:
            LaunchError: the keeper does not answer.
        """
        status, answer = self._ask("GET", "/places", timeout_s=LOOK_TIMEOUT_S)
        if status != NOT_FOUND:
            _raise_for(status, answer)
        return Room(*(int(answer.get(name, 0)) for name in ("places", "free", "free_tools")))

    def request(self, method: str, target: str, body: object, timeout_s: float) -> tuple[int, bytes]:
        """Makes one request to the keeper."""
        return ask(self._socket, method, target, body, timeout_s=timeout_s)

    def address_of(self, made_id: str, answer: dict[str, Any]) -> str:
        """Returns the address of a session or of tools, from the keeper's answer."""
        return f"unix:{answer['socket']}"

    def _look(self, state: State) -> tuple[int, dict[str, Any]]:
        try:
            return self._ask("GET", f"/sessions/{state['session']}", timeout_s=LOOK_TIMEOUT_S)
        except LaunchError as error:
            log.warning("%s", error.detail)
            return error.status, {}

    def _ask(
        self, method: str, target: str, body: object = None, *, timeout_s: float
    ) -> tuple[int, dict[str, Any]]:
        try:
            status, data = self.request(method, target, body, timeout_s)
        except NotReachedError as error:
            raise KeeperUnreachedError(f"The keeper of the executors does not answer: {error}.") from error
        except (OSError, http.client.HTTPException) as error:
            raise LaunchError(f"The keeper of the executors does not answer: {error}.") from error
        answer = read_json(data)
        return status, answer if isinstance(answer, dict) else {}


def _raise_for(status: int, answer: dict[str, Any]) -> None:
    if status == FULL:
        raise HostFullError(_detail(answer))
    if status >= 400:
        raise LaunchError(_detail(answer), hint=str(answer.get("log", "")))


def _detail(answer: dict[str, Any]) -> str:
    return str(answer.get("detail") or "The keeper of the executors refused.")
