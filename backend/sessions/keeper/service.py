"""Starts, watches and ends the containers of executors. It stores nothing, but asks Docker each time."""

from __future__ import annotations

import contextlib
import logging
import threading
import time
from datetime import UTC, datetime
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from backend.sessions.keeper.errors import KeeperError
from backend.sessions.keeper.plan import SESSION_LABEL, STACK_LABEL

if TYPE_CHECKING:
    from collections.abc import Callable

    from backend.sessions.keeper.docker import Docker
    from backend.sessions.keeper.gate import Gate
    from backend.sessions.keeper.plan import Plan

log = logging.getLogger(__name__)

LOOK_EVERY_S: Final = 0.25
LOG_LINES: Final = 20
STOP_TIMEOUT_S: Final = 10.0
KEPT_AFTER_END_S: Final = 3600.0
KEPT_REASONS: Final = 200
"""Number of sessions for which the reason of their end is kept after their containers have been removed."""


class Keeper:
    """The executors of one stack.

    Args:
        max_sessions: the number of executors that may run at the same time.
    """

    def __init__(self, docker: Docker, gate: Gate, plan: Plan, *, max_sessions: int) -> None:
        self._docker = docker
        self._gate = gate
        self._plan = plan
        self._max_sessions = max_sessions
        self._starting: set[str] = set()
        self._crowded: set[str] = set()
        self._reasons: dict[str, str] = {}
        self._lock = threading.Lock()

    def start(self, session_id: str, token: str, domain_id: int, timeout_s: float) -> dict[str, Any]:
        """Starts an executor, and returns the path at which it listens.

        Raises:
            KeeperError: the host is full, the session runs already, or its executor did not start. In that
                case its container is removed.
        """
        with self._lock:
            if session_id in self._starting or self._docker.inspect(self._plan.container_name(session_id)):
                raise KeeperError(409, "session_exists", "This session runs already.")
            running = sum(one["running"] for one in self.list() if one["session"] not in self._starting)
            if running + len(self._starting) >= self._max_sessions:
                raise KeeperError(429, "host_full", f"All {self._max_sessions} places are taken.")
            self._starting.add(session_id)
        try:
            name = self._plan.container_name(session_id)
            configure = partial(self._plan.container, session_id, token, domain_id)
            bring_up(self._docker, self._gate, name, session_id, configure, token, timeout_s)
        except BaseException:
            self._clear(session_id)
            raise
        finally:
            with self._lock:
                self._starting.discard(session_id)
        return {"socket": str(self._gate.path(session_id))}

    def look(self, session_id: str) -> dict[str, Any]:
        """Returns whether an executor runs; if it has ended, also how."""
        found = self._docker.inspect(self._plan.container_name(session_id))
        if found is None:
            # A request during the clean-up of another one gets the same answer.
            reason = self._reasons.get(session_id, "This session does not run.")
            return {"running": False, "status": None, "reason": reason}
        state = found["State"]
        if state["Running"]:
            return {"running": True, "status": None, "reason": ""}
        reason = self._reasons.get(session_id, "")
        if state.get("OOMKilled"):
            reason = f"It used more than its {self._plan.limits.memory_mb:g} MB of memory."
        return {"running": False, "status": int(state["ExitCode"]), "reason": reason}

    def list(self) -> list[dict[str, Any]]:
        """Lists every executor of this stack."""
        return [
            {
                "session": one["Labels"][SESSION_LABEL],
                "running": one["State"] == "running",
                "created": one["Created"],
            }
            for one in self._docker.list({STACK_LABEL: self._plan.stack})
            if SESSION_LABEL in one["Labels"]
        ]

    def stop(self, session_id: str, timeout_s: float) -> None:
        """Ends an executor and removes its container; may be called twice."""
        ended = self.look(session_id)
        if not ended["running"] and ended["status"] is not None and ended["reason"]:
            self._remember(session_id, ended["reason"])
        self._docker.stop(self._plan.container_name(session_id), timeout_s)
        self._clear(session_id)

    def _clear(self, session_id: str) -> None:
        with contextlib.suppress(KeeperError):
            self._docker.remove(self._plan.container_name(session_id))
        self._gate.remove(session_id)

    def _remember(self, session_id: str, reason: str) -> None:
        self._reasons[session_id] = reason
        while len(self._reasons) > KEPT_REASONS:
            self._reasons.pop(next(iter(self._reasons)))

    def end_crowded(self) -> None:
        """Kills containers that had all permitted processes at this call and at the previous one.

        With so many processes, the manager in the container has no time to end them.
        """
        crowded = set()
        for one in self.list():
            session_id = str(one["session"])
            name = self._plan.container_name(session_id)
            try:
                if not one["running"] or self._docker.processes(name) < int(self._plan.limits.pids):
                    continue
                crowded.add(session_id)
                if session_id in self._crowded:
                    log.warning("session %s has too many processes and is ended", session_id)
                    self._remember(
                        session_id, f"It had {self._plan.limits.pids:g} processes, all it may have."
                    )
                    self._docker.kill(name)
            except KeeperError as error:
                log.warning("session %s: %s", session_id, error.detail)
        self._crowded = crowded

    def tidy(self, now_s: float) -> None:
        """Ends containers that ran for too long or cannot be reached; removes old ones."""
        oldest_s = now_s - self._plan.limits.hours * 3600
        for one in self.list():
            try:
                if one["running"] and one["created"] < oldest_s:
                    log.warning("session %s has used up its time", one["session"])
                    self._docker.stop(self._plan.container_name(one["session"]), STOP_TIMEOUT_S)
                elif one["running"] and self._is_unreachable(one["session"]):
                    log.warning("session %s has no socket any more", one["session"])
                    self._remember(one["session"], "Its socket was removed with the volume that held it.")
                    self._docker.stop(self._plan.container_name(one["session"]), STOP_TIMEOUT_S)
                elif not one["running"] and one["created"] < now_s and self._ended_long_ago(one, now_s):
                    self._clear(one["session"])
            except KeeperError as error:
                log.warning("session %s: %s", one["session"], error.detail)

    def _is_unreachable(self, session_id: str) -> bool:
        """Returns whether the socket of a session no longer exists.

        This happens if the stack was given other volumes.
        """
        with self._lock:
            return session_id not in self._starting and not self._gate.path(session_id).exists()

    def _ended_long_ago(self, one: dict[str, Any], now_s: float) -> bool:
        with self._lock:
            if one["session"] in self._starting:
                return False
        found = self._docker.inspect(self._plan.container_name(one["session"]))
        return found is not None and ended_at(found["State"]) < now_s - KEPT_AFTER_END_S


def bring_up(  # noqa: PLR0913, PLR0917 - what a container is, and what it shows at the gate
    docker: Docker,
    gate: Gate,
    name: str,
    gate_id: str,
    configure: Callable[[str], dict[str, Any]],
    token: str,
    timeout_s: float,
) -> None:
    """Starts a container, and waits until it has fetched its socket from the gate.

    `configure` returns the container's settings for the path of a door.

    Raises:
        KeeperError: the container ended, or took too long; the caller must remove it.
    """
    deadline = time.monotonic() + timeout_s
    with gate.door(gate_id, token) as door:
        docker.create(name, configure(door.path))
        docker.start(name)
        while not door.wait(LOOK_EVERY_S):
            state = (docker.inspect(name) or {}).get("State", {})
            if not state.get("Running"):
                log.warning("%s ended with status %s before it was ready", name, state.get("ExitCode"))
                reason = "It ended before it was ready."
                raise KeeperError(502, "executor_failed", reason, docker.log(name, LOG_LINES))
            if time.monotonic() > deadline:
                reason = f"It was not ready within {timeout_s:g} s."
                raise KeeperError(504, "executor_slow", reason, docker.log(name, LOG_LINES))


def ended_at(state: dict[str, Any]) -> float:
    """Returns the time at which a container ended, in seconds since the epoch; Docker writes nanoseconds."""
    text = str(state.get("FinishedAt", ""))[:19]
    try:
        return datetime.fromisoformat(text).replace(tzinfo=UTC).timestamp()
    except ValueError:
        return 0.0
