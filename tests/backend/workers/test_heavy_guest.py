"""A guest asks for the XML of the largest project again and again, while others work."""

from __future__ import annotations

import asyncio
import json

import pytest

from backend.core.processes.memory import MEBIBYTE, WORK_MIB
from backend.ingress.handler import ThreadedHandler
from backend.projects.models import Project
from backend.workers.pool import Limits, Pool
from tests.backend.accounts.conftest import PUBLIC, Person, person, team  # noqa: F401 - fixtures
from tests.backend.ingress.test_bodies import head
from translator.limits import NODES_PER_PROJECT, NODES_PER_TREE

pytestmark = pytest.mark.django_db(transaction=True)
AT_ONCE = 8


def largest():
    """A project with as many nodes as it may have."""
    files = []
    for number in range(NODES_PER_PROJECT // NODES_PER_TREE):
        leaves = {f"n{n}": {"type": "AlwaysSuccess", "name": f"step {n}"} for n in range(NODES_PER_TREE - 1)}
        nodes = {"r": {"type": "Sequence", "children": list(leaves)}, **leaves}
        document = {
            "format": "bt-studio/diagram",
            "version": 1,
            "id": f"T{number}",
            "root": "r",
            "nodes": nodes,
        }
        files.append({"path": f"trees/T{number}.json", "base_revision": 0, "content": json.dumps(document)})
    return files


async def ask(handling, browser, path):
    sent = []

    async def receive():
        return {"type": "http.request", "body": b"", "more_body": False}

    async def send(message):
        sent.append(message)

    address, _, query = f"/api/v1/{path}".partition("?")
    scope = {"type": "http", "method": "GET", "path": address, "query_string": query.encode()}
    await handling(scope | {"headers": head(browser)}, receive, send)
    return sent[0]["status"], b"".join(message.get("body", b"") for message in sent[1:])


@pytest.fixture
def patient(monkeypatch):
    """A pool as on a team server with four processors, but with a deadline that a busy machine can meet."""
    made = Pool(Limits(workers=4, per_owner=2, waiting=16, deadline_s=300, memory_bytes=WORK_MIB * MEBIBYTE))
    monkeypatch.setattr("backend.projects.documents.checking.pool", lambda: made)
    yield made
    made.close()


def test_eight_requests_for_the_largest_project_leave_the_server_to_the_others(patient, person):  # noqa: F811
    owner, other, guest = person("olga"), person("otto"), Person()
    one = owner.post("projects", {"name": "Large"}, expect=201)["id"]
    owner.save(one, {"path": "trees/MainTree.json", "base_revision": 1, "delete": True})
    opened = owner.save(one, *largest())
    assert opened["checked"], opened["diagnostics"]
    settings = owner.get(f"projects/{one}")["settings"] | {"main_tree": "T0"}
    owner.patch(f"projects/{one}", {"base_revision": 1, "settings": settings})
    link = owner.post(f"projects/{one}/shares/links", {}, expect=201)["links"][0]["url"]
    guest.page(link.partition(PUBLIC)[2])
    other.post("projects", {"name": "Small"}, expect=201)

    async def attack():
        handling = ThreadedHandler()
        paths = [f"projects/{one}/xml?self_contained={n % 2}" for n in range(AT_ONCE)]
        heavy = [asyncio.ensure_future(ask(handling, guest, path)) for path in paths]
        served = 0
        while not all(task.done() for task in heavy):
            assert (await ask(handling, other, "projects"))[0] == 200
            served += 1
            assert handling.threads.full_for_s() == 0  # a thread was free for the answer that came just now
        return served, await asyncio.gather(*heavy)

    served, answers = asyncio.run(attack())
    assert served > AT_ONCE
    for status, body in answers:
        assert status == 200, body[:500]
        assert body.count(b"<AlwaysSuccess") == NODES_PER_PROJECT - NODES_PER_PROJECT // NODES_PER_TREE
    assert Project.objects.count() == 2
