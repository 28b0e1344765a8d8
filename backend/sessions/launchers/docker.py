"""Runs each executor in a container, which the keeper starts; executors outlive the web server.

The web server never uses Docker directly. It sends the id and the token of a session to the keeper
(`backend/sessions/keeper`), and receives the path of the unix socket at which the manager listens.
"""

from __future__ import annotations

import http.client
import logging
from pathlib import Path
from typing import Any, Final

from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.keeper.unix_http import ask, read_json
from backend.sessions.launchers.base import UNKNOWN_EXIT, Launcher, Spec, Started, State

log = logging.getLogger(__name__)

FOLDER: Final = Path("/run/bt-studio-keeper")
FULL: Final = 429
MARGIN_S: Final = 30.0
LOOK_TIMEOUT_S: Final = 5.0


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
        return Started(_address(answer), {"session": spec.session_id})

    def open_tools(self, tools_id: str, token: str, *, timeout_s: float) -> str:
        """Returns the address at which a user's tools listen; starts their container if necessary."""
        body = {"tools": tools_id, "token": token, "timeout_s": timeout_s}
        status, answer = self._ask("POST", "/tools", body, timeout_s=timeout_s + MARGIN_S)
        _raise_for(status, answer)
        return _address(answer)

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
            status, data = ask(self._socket, method, target, body, timeout_s=timeout_s)
        except (OSError, http.client.HTTPException) as error:
            raise LaunchError(f"The keeper of the executors does not answer: {error}.") from error
        answer = read_json(data)
        return status, answer if isinstance(answer, dict) else {}


def _address(answer: dict[str, Any]) -> str:
    """Returns the address of a session or of tools, from the keeper's answer."""
    return f"unix:{answer['socket']}"


def _raise_for(status: int, answer: dict[str, Any]) -> None:
    if status == FULL:
        raise HostFullError(_detail(answer))
    if status >= 400:
        raise LaunchError(_detail(answer), hint=str(answer.get("log", "")))


def _detail(answer: dict[str, Any]) -> str:
    return str(answer.get("detail") or "The keeper of the executors refused.")
