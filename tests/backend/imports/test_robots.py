"""Robots with macros are looked at once for each content, by several threads."""

from __future__ import annotations

import sys
import zipfile
from concurrent.futures import ThreadPoolExecutor
from typing import Any
from uuid import UUID

import pytest

from backend.imports import robots as module
from backend.imports.errors import NotLookedAtError
from backend.imports.robots import look
from backend.projects.documents.checking import Robots, robots_of
from backend.projects.storage import queries
from backend.projects.storage.access import Need
from tests.executor.expansion.probes import probes

FOUND = b'{"findings": [{"file": "robots/a/r.xacro", "line": 3, "message": "wrong"}]}'


@pytest.fixture
def asked(monkeypatch):
    """The contents that the child got, one dictionary for each time."""
    found = []

    def run(header, upload, stop):
        with zipfile.ZipFile(upload) as archive:
            found.append({path: archive.read(path) for path in archive.namelist()})
        return FOUND

    monkeypatch.setattr("backend.imports.robots.runner", lambda _: run)
    return found


def test_equal_files_are_looked_at_once(user, asked, tmp_path):
    files = [("robots/a/r.xacro", probes(tmp_path)[0].encode())]
    for _ in range(2):
        [found] = look(user, Robots("key of this test", files)).result()
        assert (found["code"], found["file"], found["line"], found["message"]) == (
            "BT0916",
            "robots/a/r.xacro",
            3,
            "wrong",
        )
    assert asked == [dict(files)]


@pytest.mark.django_db(transaction=True)
def test_what_is_looked_at_is_what_is_remembered(api, user, asked):
    """A save between the two must not give the old state what was found in the new one."""
    made = api.post("projects", {"name": "Robot"}, expect=201)["id"]
    path = "robots/a/r.xacro"
    api.save(made, {"path": path, "base_revision": 0, "content": "<old/>"})
    project = queries.project(UUID(made), user=user, need=Need.READ)
    before = robots_of(project, {"robots/a/.git/config": b"x", "robots/a/typed": b"t", "notes": b"n"})
    api.save(made, {"path": path, "base_revision": 2, "content": "<new/>"})
    look(user, before).result()
    after = robots_of(queries.project(UUID(made), user=user, need=Need.READ), {})
    assert after.key != before.key
    look(user, after).result()
    assert asked == [{path: b"<old/>", "robots/a/typed": b"t"}, {path: b"<new/>"}]


def test_a_child_without_an_answer_is_an_error_and_nothing_is_remembered(user, monkeypatch, asked):
    robots = Robots("key without an answer", [])
    with monkeypatch.context() as patch:
        patch.setattr("backend.imports.robots.runner", lambda _: lambda *_: b"")
        with pytest.raises(NotLookedAtError) as error:
            look(user, robots).result()
    assert error.value.document()["code"] == "robots_not_looked_at"
    assert len(look(user, robots).result()) == 1


def test_what_is_remembered_is_read_and_written_by_many_threads(monkeypatch):
    monkeypatch.setattr(module, "MOST_KNOWN", 2)
    known: Any = module.Known()

    def use(number):
        for step in range(2_000):
            key = str((number + step) % 5)
            known.put(key, (key,))
            found = known.get(str((number * step) % 5))
            assert found is None or found == (str((number * step) % 5),)

    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(8) as threads:
            list(threads.map(use, range(8)))
    finally:
        sys.setswitchinterval(before)
