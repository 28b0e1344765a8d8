"""The server is killed in a storm of saves: what it acknowledged is there, and nothing is half there."""

from __future__ import annotations

import random
import signal
import sqlite3
import threading

import pytest
import requests

from tests.backend.serving import serving
from tests.budget import count

FILES = ("a.txt", "b.txt", "c.txt")
WRITERS = 3


class Storm:
    """Writers that save three files at a time, each save with one text, and note what was acknowledged."""

    def __init__(self, server, projects, enough):
        self.server = server
        self.projects = projects
        self.acknowledged = {project: {} for project in projects}
        self.saves = 0
        self.enough = enough
        self.raging = threading.Event()

    def rage(self):
        threads = [threading.Thread(target=self.write, args=(project,)) for project in self.projects]
        for thread in threads:
            thread.start()
        assert self.raging.wait(60)
        self.server.process.kill()
        for thread in threads:
            thread.join()

    def write(self, project):
        session = requests.Session()
        session.headers.update(self.server.headers)
        address = f"{self.server.base}/api/v1/projects/{project}"
        revision = session.get(address).json()["revision"]
        for number in range(100_000):
            text = f"{self.server.token} {number}"
            body = {
                "files": [
                    {"path": p, "base_revision": revision if revision > 1 else 0, "content": text}
                    for p in FILES
                ]
            }
            try:
                answer = session.post(f"{address}/changes", json=body)
            except requests.RequestException:
                return
            assert answer.status_code == 200, answer.text
            revision = answer.json()["revision"]
            self.acknowledged[project][revision] = text
            self.saves += 1
            if self.saves >= self.enough:
                self.raging.set()


def check(server, project, acknowledged):
    """Every acknowledged revision is there, whole; at most one more was written and not acknowledged."""
    address = f"{server.base}/api/v1/projects/{project}"
    newest = requests.get(address, headers=server.headers, timeout=30).json()
    assert max(acknowledged, default=1) <= newest["revision"] <= max(acknowledged, default=1) + 1
    now = {f["path"]: f["content"] for f in newest["files"]}
    assert len({now.get(path) for path in FILES}) == 1
    for revision, text in acknowledged.items():
        for path in FILES:
            found = requests.get(
                f"{address}/revisions/{revision}/files/{path}", headers=server.headers, timeout=30
            )
            assert found.text == text


@pytest.mark.timeout(0)
def test_no_acknowledged_save_is_lost_when_the_server_is_killed(tmp_path):
    kills = count("backend_kill_storm")
    seed = 7
    chance = random.Random(seed)  # noqa: S311
    storm = None
    for kill in range(kills + 1):
        with serving(tmp_path) as server:
            if storm is not None:
                for project, acknowledged in storm.acknowledged.items():
                    check(server, project, acknowledged)
            if kill == kills:
                break
            if storm is None:
                made = [
                    requests.post(
                        f"{server.base}/api/v1/projects",
                        json={"name": f"P{n}"},
                        headers=server.headers,
                        timeout=30,
                    ).json()
                    for n in range(WRITERS)
                ]
                projects = [project["id"] for project in made]
            storm = Storm(server, projects, chance.randint(5, 25))
            storm.rage()
            assert server.process.wait() == -signal.SIGKILL
    database = sqlite3.connect(tmp_path / "bt-studio.sqlite3")
    assert database.execute("PRAGMA integrity_check").fetchone() == ("ok",)
    assert database.execute("PRAGMA foreign_key_check").fetchall() == []
    database.close()
