"""Empties a server as its user can: runs and projects are deleted, which ends their sessions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.e2e.server import RARELY_S, wait_until

if TYPE_CHECKING:
    from playwright.sync_api import APIRequestContext, Playwright

    from tests.e2e.server import Server

SHELVES = ("current", "archived")


class Reset:
    """A client of the server that has the link of its user."""

    def __init__(self, playwright: Playwright, server: Server) -> None:
        self._server = server
        self._api = f"{server.origin}/api/v1"
        self._client: APIRequestContext = playwright.request.new_context(
            extra_http_headers={"Origin": server.origin}
        )
        assert self._client.get(server.url).ok

    def start_over(self) -> None:
        """Deletes all runs and projects; waits until no process of a session is left."""
        for run in self._listed("runs"):
            self._delete(f"runs/{run}")
        for shelf in SHELVES:
            for project in self._listed(f"projects?shelf={shelf}"):
                self._delete(f"projects/{project}")
        wait_until(lambda: not self._server.children(), "the processes of each session end", every_s=RARELY_S)

    def close(self) -> None:
        """Ends the client."""
        self._client.dispose()

    def _listed(self, path: str) -> list[str]:
        answer = self._client.get(f"{self._api}/{path}")
        assert answer.ok, answer.text()
        return [each["id"] for each in answer.json()["items"]]

    def _delete(self, path: str) -> None:
        answer = self._client.delete(f"{self._api}/{path}")
        assert answer.ok, answer.text()
