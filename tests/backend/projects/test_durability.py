"""The server is killed during many saves, or its disk becomes full: all acknowledged saves are complete."""

from __future__ import annotations

import logging
import random
import signal
import sqlite3
import tempfile
import threading
import time
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import pytest
import requests

from tests.backend.disks import MEBIBYTE, may_mount, small_disk
from tests.backend.services import cluster
from tests.backend.serving import TIMEOUT_S, serving
from tests.budget import count

log = logging.getLogger(__name__)
FILES = ("a.txt", "b.txt", "c.txt")
WRITERS = 3


class Storm:
    """Writers that save three files at a time, each save with one text, and record what was acknowledged."""

    def __init__(self, server, name, projects, enough):
        self.server = server
        self.name = name
        self.projects = projects
        self.acknowledged: dict[Any, Any] = {project: {} for project in projects}
        self.saves = 0
        self.enough = enough
        self.raging = threading.Event()

    def rage(self):
        threads = [threading.Thread(target=self.write, args=(project,)) for project in self.projects]
        for thread in threads:
            thread.start()
        assert self.raging.wait(TIMEOUT_S)
        assert self.server.end(signal.SIGKILL) == -signal.SIGKILL
        for thread in threads:
            thread.join()

    def write(self, project):
        session = requests.Session()
        session.headers.update(self.server.headers)
        address = f"{self.server.base}/api/v1/projects/{project}"
        with suppress(requests.RequestException):  # the server was killed
            revision = answered(session.get, address)["revision"]
            for number in range(100_000):
                text = f"{self.name} {number}"
                base = revision if revision > 1 else 0
                files = [{"path": p, "base_revision": base, "content": text} for p in FILES]
                revision = answered(session.post, f"{address}/changes", json={"files": files})["revision"]
                self.acknowledged[project][revision] = text
                self.saves += 1
                if self.saves >= self.enough:
                    self.raging.set()


def reached(ask, address, **options):
    """Returns an answer; while the database cannot be reached (503), the request is repeated."""
    deadline = time.monotonic() + TIMEOUT_S
    while True:
        answer = ask(address, **{"timeout": TIMEOUT_S} | options)
        if answer.status_code != 503 or time.monotonic() > deadline:
            break
        log.warning("%s: %s", address, answer.text)
        time.sleep(0.2)
    assert answer.status_code == 200, (answer.status_code, answer.text)
    return answer


def answered(ask, address, **options):
    """Returns the JSON of such an answer."""
    return reached(ask, address, **options).json()


def check(server, project, acknowledged, since):
    """Checks that every acknowledged revision is complete, and that at most one other revision was written.

    `since` is the revision before; returns the one that the project has now.
    """
    with requests.Session() as session:
        session.headers.update(server.headers)
        address = f"{server.base}/api/v1/projects/{project}"
        newest = answered(session.get, address)
        known = max(acknowledged, default=since)  # the kill may come before the first save of a writer
        assert known <= newest["revision"] <= known + 1
        now = {f["path"]: f["content"] for f in newest["files"]}
        assert len({now.get(path) for path in FILES}) == 1
        for revision, text in acknowledged.items():
            for path in FILES:
                found = session.get(f"{address}/revisions/{revision}/files/{path}", timeout=TIMEOUT_S)
                assert found.text == text
        return newest["revision"]


@pytest.fixture(params=["sqlite", "postgresql"])
def database(request):
    """Settings of a server on this database."""
    if request.param == "sqlite":
        yield {}
        return
    # The web server is killed, not the database: what is committed is safe without a sync.
    yield {"BT_STUDIO_DATABASE_URL": request.getfixturevalue("database_url")}


def make_projects(server, number):
    made = [
        requests.post(
            f"{server.base}/api/v1/projects",
            json={"name": f"P{n}"},
            headers=server.headers,
            timeout=TIMEOUT_S,
        ).json()
        for n in range(number)
    ]
    return [project["id"] for project in made]


@pytest.mark.kills
@pytest.mark.timeout(0)
def test_no_acknowledged_save_is_lost_when_the_server_is_killed(tmp_path, database):
    kills = count("backend_kill_storm")
    chance = random.Random(7)  # noqa: S311
    storm, saves = None, 0
    for kill in range(kills + 1):
        with serving(tmp_path, **database) as server:
            if storm is None:
                projects = make_projects(server, WRITERS)
                revisions = dict.fromkeys(projects, 1)
            else:
                for project, acknowledged in storm.acknowledged.items():
                    revisions[project] = check(server, project, acknowledged, revisions[project])
                    saves += len(acknowledged)
            if kill < kills:
                storm = Storm(server, str(kill), projects, chance.randint(5, 25))
                storm.rage()
    log.info("%d kills, %d acknowledged saves, %d files compared", kills, saves, saves * len(FILES))
    if not database:
        assert_sound(tmp_path)


def assert_sound(folder):
    database = sqlite3.connect(folder / "bt-studio.sqlite3")
    assert database.execute("PRAGMA integrity_check").fetchone() == ("ok",)
    assert database.execute("PRAGMA foreign_key_check").fetchall() == []
    database.close()


def fill(server, project):
    """Saves until the disk is full; returns the acknowledged saves, and the answer that was a refusal."""
    address = f"{server.base}/api/v1/projects/{project}/changes"
    acknowledged: dict[int, str] = {}
    revision = 0
    while True:
        text = random.Random(revision).randbytes(MEBIBYTE // 4).hex()  # noqa: S311
        body: Any = {"files": [{"path": p, "base_revision": revision, "content": p + text} for p in FILES]}
        answer = requests.post(address, json=body, headers=server.headers, timeout=TIMEOUT_S)
        if answer.status_code != 200:
            return acknowledged, answer
        revision = answer.json()["revision"]
        acknowledged[revision] = text


def written(server, project, revision, ask=requests.get):
    """Returns the text that all files of a revision contain, each after its own name."""
    found = set()
    for path in FILES:
        address = f"{server.base}/api/v1/projects/{project}/revisions/{revision}/files/{path}"
        answer = ask(address, headers=server.headers, timeout=TIMEOUT_S)
        assert answer.text.startswith(path), answer.text
        found.add(answer.text.removeprefix(path))
    (text,) = found
    return text


@pytest.mark.kills
def test_no_acknowledged_save_is_lost_when_the_disk_is_full(tmp_path):
    with small_disk(tmp_path / "disk", 24) as disk:
        with serving(disk.folder, prefix=disk.prefix) as server:
            (project,) = make_projects(server, 1)
            acknowledged, refused = fill(server, project)
            assert (refused.status_code, refused.json()["code"]) == (507, "disk_full")
            assert len(acknowledged) > 1
            # Reading continues.
            assert {n: written(server, project, n) for n in acknowledged} == acknowledged
            server.process.kill()
        disk.grow(96)
        with serving(disk.folder, prefix=disk.prefix) as server:
            assert {n: written(server, project, n) for n in acknowledged} == acknowledged
            newest = max(acknowledged)
            body = {"files": [{"path": p, "base_revision": newest, "content": "room again"} for p in FILES]}
            address = f"{server.base}/api/v1/projects/{project}/changes"
            again = requests.post(address, json=body, headers=server.headers, timeout=TIMEOUT_S)
            assert again.json()["revision"] == newest + 1
        assert_sound(disk.folder)


def fill_and_make_room(server, database, disk, *, log_too):
    (project,) = make_projects(server, 1)
    acknowledged, refused = fill(server, project)
    code = refused.json()["code"]
    assert (refused.status_code, code) == (507, "disk_full") or (log_too and code == "database_unavailable")
    assert len(acknowledged) > 1
    log.info("%d saves, then %s", len(acknowledged), code)
    if not log_too:  # reading continues
        assert {n: written(server, project, n) for n in acknowledged} == acknowledged
    disk.grow(256)
    database.start()
    newest = answered(requests.get, f"{server.base}/api/v1/projects/{project}", headers=server.headers)[
        "revision"
    ]
    # A save that was reported as failed may have been stored: the answer was lost, not the save.
    assert newest in {max(acknowledged), max(acknowledged) + 1}
    patient = partial(reached, requests.get)
    assert {n: written(server, project, n, patient) for n in acknowledged} == acknowledged
    body = {"files": [{"path": p, "base_revision": newest, "content": "room again"} for p in FILES]}
    address = f"{server.base}/api/v1/projects/{project}/changes"
    again = answered(requests.post, address, json=body, headers=server.headers)
    assert again["revision"] == newest + 1


if may_mount():  # otherwise the report says that this was not tested

    @pytest.mark.parametrize("log_too", [True, False][: count("backend_full_postgresql")])
    def test_no_acknowledged_save_is_lost_when_the_disk_of_postgresql_is_full(tmp_path, log_too):
        """Without disk space for its log, PostgreSQL may end too; it is then started again."""
        with tempfile.TemporaryDirectory(prefix="bts-") as name, small_disk(Path(name) / "disk", 52) as disk:
            Path(name).chmod(0o755)  # PostgreSQL's own user must be able to enter the folder
            places = {"data": disk.folder / "data", "log": None if log_too else Path(name) / "log"}
            small = {"segment_mb": 1, "min_wal_size": "2MB", "max_wal_size": "6MB"}
            with (
                cluster(Path(name), **places, **small) as database,
                serving(tmp_path, BT_STUDIO_DATABASE_URL=database.url) as server,
            ):
                fill_and_make_room(server, database, disk, log_too=log_too)
