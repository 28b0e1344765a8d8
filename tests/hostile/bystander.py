"""Another user at work: opens, lists, saves trees and Python files, and measures each request.

`python -m tests.hostile.bystander` takes a plan as JSON on stdin and prints samples as JSON: kind, start,
milliseconds, status. Every answer must be correct: a save's revision is the next save's base.
"""

from __future__ import annotations

import http.client
import json
import sys
import time
from typing import Any, NamedTuple

TREE, ACTION = "trees/MainTree.json", "actions/Forward.py"
TIMEOUT_S = 120


class Sample(NamedTuple):
    """One request."""

    kind: str
    at: float
    ms: float
    status: int


class Bystander:
    """A user with one project and one persistent connection, as a browser has."""

    def __init__(  # noqa: PLR0917 - as a plan has it
        self, host: str, port: int, origin: str, cookie: str, project: str, session: str = ""
    ) -> None:
        self.samples: list[Sample] = []
        self._project, self._session = project, session
        self._headers = {"Host": origin.partition("://")[2], "Origin": origin, "Cookie": cookie}
        self._connection = http.client.HTTPConnection(host, port, timeout=TIMEOUT_S)
        self._rounds = 0
        opened = json.loads(self._ask("open", "GET", f"projects/{project}"))
        self._files = {file["path"]: file for file in opened["files"]}

    def close(self) -> None:
        """Closes the connection."""
        self._connection.close()

    def round(self, pause_s: float = 0.0) -> None:
        """Sends one request of each kind, with pauses between them."""
        self._rounds += 1
        one = f"projects/{self._project}"
        for step in (
            self._save_tree,
            lambda: self._ask("open", "GET", one),
            self._save_python,
            lambda: self._ask("python file", "GET", f"{one}/files/{ACTION}"),
            lambda: self._ask("list", "GET", "projects?limit=20"),
            lambda: self._ask("tree file", "GET", f"{one}/files/{TREE}"),
            lambda: self._ask("history", "GET", f"{one}/revisions?limit=20"),
            *([self._look_at_session] if self._session else []),
        ):
            step()
            time.sleep(pause_s)  # the pace of a person

    def _look_at_session(self) -> None:
        found = json.loads(self._ask("session", "GET", f"sessions/{self._session}"))
        assert found["state"] == "ready", found

    def _save_tree(self) -> None:
        tree = json.loads(self._files[TREE]["content"])
        next(iter(tree["nodes"].values()))["comment"] = f"round {self._rounds}"
        self._save("save a tree", TREE, json.dumps(tree))

    def _save_python(self) -> None:
        source = self._files[ACTION]["content"].partition("\n# round")[0]
        self._save("save Python", ACTION, f"{source}\n# round {self._rounds}\n")

    def _save(self, kind: str, path: str, content: str) -> None:
        file = self._files[path]
        change = {"path": path, "content": content, "base_revision": file["revision"]}
        answer = json.loads(self._ask(kind, "POST", f"projects/{self._project}/changes", {"files": [change]}))
        assert answer["revision"] > file["revision"], answer
        self._files[path] = file | {"revision": answer["revision"], "content": content}

    def _ask(self, kind: str, method: str, path: str, body: Any = None) -> bytes:
        headers = self._headers | ({} if body is None else {"Content-Type": "application/json"})
        data = None if body is None else json.dumps(body)
        at, began = time.time(), time.perf_counter()
        try:
            self._connection.request(method, f"/api/v1/{path}", data, headers)
            response = self._connection.getresponse()
        except http.client.RemoteDisconnected:  # the connection was idle for long
            self._connection.close()
            self._connection.request(method, f"/api/v1/{path}", data, headers)
            response = self._connection.getresponse()
        answer = response.read()
        self.samples.append(Sample(kind, at, 1000 * (time.perf_counter() - began), response.status))
        assert response.status < 400, (kind, response.status, answer[:1000])
        return answer


def main() -> None:
    plan = json.load(sys.stdin)
    worker = Bystander(**plan["who"])
    end = time.monotonic() + plan["seconds"]
    while time.monotonic() < end:
        worker.round(plan["pause_s"])
    worker.close()
    json.dump(worker.samples, sys.stdout)


if __name__ == "__main__":
    main()
