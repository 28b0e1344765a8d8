"""The few calls of the Docker Engine's API that the keeper makes."""

from __future__ import annotations

import http.client
import json
from typing import Any, Final
from urllib.parse import quote, urlencode

from backend.sessions.keeper.errors import KeeperError
from backend.sessions.keeper.unix_http import ask, read_json

API: Final = "/v1.41"
NOT_FOUND: Final = 404
NOT_RUNNING: Final = 409
LOG_HEADER_BYTES: Final = 8


class Docker:
    """A Docker Engine."""

    def __init__(self, socket_path: str) -> None:
        self._socket_path = socket_path

    def create(self, name: str, config: dict[str, Any]) -> str:
        """Creates a container; returns its id."""
        return str(self._call("POST", f"/containers/create?name={quote(name)}", config)["Id"])

    def start(self, container: str) -> None:
        """Starts a container."""
        self._call("POST", f"/containers/{quote(container)}/start")

    def inspect(self, container: str) -> dict[str, Any] | None:
        """Returns Docker's record of a container; None if it does not exist."""
        found = self._call("GET", f"/containers/{quote(container)}/json", missing=True)
        return found if isinstance(found, dict) else None

    def list(self, labels: dict[str, str]) -> list[dict[str, Any]]:
        """Returns all containers with these labels, including ended ones."""
        filters = json.dumps({"label": [f"{key}={value}" for key, value in labels.items()]})
        found = self._call("GET", "/containers/json?" + urlencode({"all": "1", "filters": filters}))
        return list(found)

    def processes(self, container: str) -> int:
        """Returns the number of processes and threads of a container."""
        path = f"/containers/{quote(container)}/stats?stream=0&one-shot=1"
        stats = self._call("GET", path, missing=True) or {}
        return int(stats.get("pids_stats", {}).get("current") or 0)

    def kill(self, container: str) -> None:
        """Kills all processes in a container immediately, if it runs."""
        status, data = self._ask("POST", f"/containers/{quote(container)}/kill")
        if status >= 400 and status not in {NOT_FOUND, NOT_RUNNING}:
            raise KeeperError(502, "docker_failed", f"Docker refused: {data.decode(errors='replace')}.")

    def stop(self, container: str, timeout_s: float) -> None:
        """Asks the container to end, and kills it after a timeout."""
        path = f"/containers/{quote(container)}/stop?t={max(1, round(timeout_s))}"
        self._call("POST", path, missing=True, timeout_s=timeout_s + 30)

    def remove(self, container: str) -> None:
        """Removes a container, if it exists."""
        self._call("DELETE", f"/containers/{quote(container)}?force=1&v=1", missing=True)

    def log(self, container: str, lines: int) -> str:
        """Returns the last lines that a container printed."""
        path = f"/containers/{quote(container)}/logs?stdout=1&stderr=1&tail={lines}"
        _, data = self._ask("GET", path)
        return _without_headers(data).decode(errors="replace")

    def _call(
        self, method: str, path: str, body: object = None, *, missing: bool = False, timeout_s: float = 60
    ) -> Any:
        status, data = self._ask(method, path, body, timeout_s)
        if status < 400:
            return read_json(data)
        if status == NOT_FOUND and missing:
            return None
        answer = read_json(data)
        reason = answer.get("message", "") if isinstance(answer, dict) else ""
        raise KeeperError(502, "docker_failed", f"Docker refused: {reason or status}.")

    def _ask(self, method: str, path: str, body: object = None, timeout_s: float = 60) -> tuple[int, bytes]:
        try:
            return ask(self._socket_path, method, API + path, body, timeout_s=timeout_s)
        except (OSError, http.client.HTTPException) as error:
            raise KeeperError(502, "docker_unreachable", f"Docker does not answer: {error}.") from error


def _without_headers(data: bytes) -> bytes:
    """Returns the text of a log without the header of each piece (stream, three zeros, length)."""
    text, at = b"", 0
    while at + LOG_HEADER_BYTES <= len(data):
        length = int.from_bytes(data[at + 4 : at + LOG_HEADER_BYTES], "big")
        text += data[at + LOG_HEADER_BYTES : at + LOG_HEADER_BYTES + length]
        at += LOG_HEADER_BYTES + length
    return text
