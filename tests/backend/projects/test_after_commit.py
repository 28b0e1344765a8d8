"""A stored save is reported as stored, even if something fails after the commit."""

from __future__ import annotations

import threading
from concurrent.futures import Future
from typing import Any

import pytest
from django.db import OperationalError

from backend.core import notify
from backend.projects.api import presentation
from backend.projects.signals import project_deleted
from backend.projects.storage import queries
from backend.workers.errors import BusyError, WorkFailedError
from backend.workers.priorities import Pools

pytestmark = pytest.mark.django_db(transaction=True)


def fails(error):
    def failing(*_, **__):
        raise error

    return failing


def fails_later(error):
    """A task that fails while it runs."""
    failed: Future[Any] = Future()
    failed.set_exception(error)
    return lambda *_, **__: failed


def no_checks(monkeypatch):
    monkeypatch.setattr(Pools, "ask", fails_later(WorkFailedError("The worker was killed.")))


DOWN = OperationalError("the database went away")
STEPS = {
    "the check": (Pools, "ask", WorkFailedError("The worker was killed.")),
    "the pool": (Pools, "ask", BusyError("Too much waits.")),
    "the contents": (queries, "contents", DOWN),
    "the notices": (notify._teller, "tell", ConnectionError("Redis is down")),
    "the channel layer": (notify, "get_channel_layer", ConnectionError("Redis is down")),
}


@pytest.fixture(params=STEPS)
def broken(request, monkeypatch):
    def breaks():
        where, what, error = STEPS[request.param]
        failing = fails_later(error) if isinstance(error, WorkFailedError) else fails(error)
        monkeypatch.setattr(where, what, failing)
        if what == "tell":
            monkeypatch.setattr("backend.projects.api.notices.tell", fails(error))

    return breaks


@pytest.fixture
def one(api):
    return api.post("projects", {"name": "Robot"}, expect=201)["id"]


def python(base, text):
    return {"path": "actions/Go.py", "base_revision": base, "content": text}


def test_a_save_is_acknowledged_and_the_next_one_is_no_conflict(api, one, broken):
    broken()
    first = api.save(one, python(0, "first = 1\n"))
    (file,) = [each for each in first["files"] if each["path"] == "actions/Go.py"]
    assert first["revision"] == file["revision"] == 2
    second = api.save(one, python(2, "second = 2\n"))
    assert second["revision"] == 3
    if not first["checked"]:
        assert [each["code"] for each in first["diagnostics"]] == ["BT0009"]


def test_an_answer_that_is_kept_for_its_key_is_the_same(api, one, monkeypatch):
    no_checks(monkeypatch)
    again = {"expect": 200, "Idempotency_Key": "k1"}
    first = api.save(one, python(0, "x = 1\n"), **again)
    assert api.save(one, python(0, "x = 1\n"), **again) == first
    assert api.get(f"projects/{one}")["revision"] == 2


WRITES = {
    "settings": lambda api, one: api.patch(f"projects/{one}", {"base_revision": 1, "name": "New"}),
    "duplicate": lambda api, one: api.post(f"projects/{one}/duplicate", {"name": "Copy"}, expect=201),
    "archive": lambda api, one: api.post(f"projects/{one}/archive"),
    "create": lambda api, _: api.post("projects", {"name": "Other"}, expect=201),
    "open": lambda api, one: api.get(f"projects/{one}"),
    "check": lambda api, one: api.post(f"projects/{one}/check", {"files": []}),
}


@pytest.mark.parametrize("write", WRITES)
def test_other_writes_and_looks_are_answered_too(api, one, monkeypatch, write):
    no_checks(monkeypatch)
    answer = WRITES[write](api, one)
    assert answer["checked"] is False
    assert [each["code"] for each in answer["diagnostics"]] == ["BT0009"]


@pytest.mark.parametrize("write", ["settings", "duplicate", "create"])
def test_what_cannot_be_answered_is_not_written(api, one, monkeypatch, write):
    """The answer reads its data in the transaction, so an error means that nothing was stored."""
    monkeypatch.setattr(presentation, "opened", fails(DOWN))
    before = api.get("projects")["items"]
    calls = {"settings": ("PATCH", f"projects/{one}", {"base_revision": 1, "name": "New"})}
    calls |= {"duplicate": ("POST", f"projects/{one}/duplicate", {"name": "Copy"})}
    calls |= {"create": ("POST", "projects", {"name": "Other"})}
    api.call(*calls[write], expect=503)
    assert api.get("projects")["items"] == before


def test_a_deletion_is_acknowledged_when_those_who_hear_of_it_fail(api, one):
    deaf = fails(RuntimeError("the keeper does not answer"))
    project_deleted.connect(deaf, dispatch_uid="deaf")
    try:
        api.delete(f"projects/{one}")
    finally:
        project_deleted.disconnect(dispatch_uid="deaf")
    api.get(f"projects/{one}", expect=404)


def test_eight_clients_that_save_python_at_once_are_all_answered(api, one):
    from tests.backend.conftest import Api

    failures = []

    def saving(number):
        mine, path = Api(), f"actions/Go{number}.py"
        try:
            base = 0
            for version in range(5):
                text = f"value = {version}\n" + "".join(f"f({n}, a=[1, {number}])\n" for n in range(60))
                change = {"path": path, "base_revision": base, "content": text}
                answer = mine.save(one, change)
                assert answer["checked"], answer["diagnostics"]
                base = next(each["revision"] for each in answer["files"] if each["path"] == path)
        except AssertionError as error:
            failures.append(error)
        finally:
            from django.db import connection

            connection.close()

    threads = [threading.Thread(target=saving, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == []
