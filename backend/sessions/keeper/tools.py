"""The containers with users' tools: one for each user with an open editor, made at the first request.

The containers store no data. They end by themselves when no editor has been open for a while; a web server
that finds the socket closed requests them again.
"""

from __future__ import annotations

import logging
import threading
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from backend.sessions.keeper.errors import KeeperError
from backend.sessions.keeper.plan import STACK_LABEL, TOOLS_LABEL
from backend.sessions.keeper.service import bring_up

if TYPE_CHECKING:
    from backend.sessions.keeper.docker import Docker
    from backend.sessions.keeper.gate import Gate
    from backend.sessions.keeper.plan import Plan

log = logging.getLogger(__name__)

STOP_TIMEOUT_S: Final = 2.0


class ToolsKeeper:
    """Manages the tools of one stack.

    Args:
        max_tools: the number of users that may have tools at the same time.
    """

    def __init__(self, docker: Docker, gate: Gate, plan: Plan, *, max_tools: int) -> None:
        self._docker = docker
        self._gate = gate
        self._plan = plan
        self.max_tools = max_tools
        self._opening: set[str] = set()
        self._changed = threading.Condition()

    def open(self, tools_id: str, token: str, timeout_s: float) -> dict[str, Any]:
        """Returns the path at which a user's tools listen; starts them if they do not run.

        Raises:
            KeeperError: the host is full, or the tools did not start. In that case their container is
                removed.
        """
        name = self._plan.tools_name(tools_id)
        with self._changed:
            # Two pages of one user open at the same time.
            self._changed.wait_for(lambda: tools_id not in self._opening)
            if self._runs(name):
                return {"socket": str(self._gate.path(tools_id))}
            others = {one["tools"] for one in self._list() if one["running"]} | self._opening
            if len(others) >= self.max_tools:
                raise KeeperError(429, "host_full", f"All {self.max_tools} places for editors are taken.")
            self._opening.add(tools_id)
        try:
            self._clear(tools_id)
            configure = partial(self._plan.tools, tools_id, token)
            bring_up(self._docker, self._gate, name, tools_id, configure, token, timeout_s)
        except BaseException:
            self._clear(tools_id)
            raise
        finally:
            with self._changed:
                self._opening.discard(tools_id)
                self._changed.notify_all()
        return {"socket": str(self._gate.path(tools_id))}

    def tidy(self, now_s: float) -> None:
        """Removes tools that have ended, and ends those that ran for too long."""
        oldest_s = now_s - self._plan.tools_limits.hours * 3600
        for one in self._list():
            tools_id = one["tools"]
            with self._changed:
                if tools_id in self._opening:
                    continue
            try:
                if one["running"] and one["created"] < oldest_s:
                    self._docker.stop(self._plan.tools_name(tools_id), STOP_TIMEOUT_S)
                elif not one["running"]:
                    self._clear(tools_id)
            except KeeperError as error:
                log.warning("the tools %s: %s", tools_id, error.detail)

    def _runs(self, name: str) -> bool:
        found = self._docker.inspect(name)
        return found is not None and bool(found["State"]["Running"])

    def _list(self) -> list[dict[str, Any]]:
        found = self._docker.list({STACK_LABEL: self._plan.stack})
        return [
            {
                "tools": one["Labels"][TOOLS_LABEL],
                "running": one["State"] == "running",
                "created": one["Created"],
            }
            for one in found
            if TOOLS_LABEL in one["Labels"]
        ]

    def _clear(self, tools_id: str) -> None:
        self._docker.remove(self._plan.tools_name(tools_id))
        self._gate.remove(tools_id)
