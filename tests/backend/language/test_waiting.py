"""Pages that wait for a place of a language server."""

from __future__ import annotations

import json
import sys
from typing import Any

import pytest

from backend.core.processes.fair_places import Turn
from backend.language import consumers, servers, waiting
from backend.language.waiting import METHOD
from tests.backend.language.conftest import opened
from tests.backend.language.test_consumers import FAKE

pytestmark = pytest.mark.django_db(transaction=True)


def turns_of(page, last):
    """The turns that the page gets, until it gets this one."""
    told: list[Any] = []
    while not told or told[-1] != last:
        message = json.loads(page.socket.recv(timeout=60))
        if message.get("method") == METHOD:
            told.append(message["params"])
    return told


def test_a_page_that_finds_no_place_waits_and_gets_its_turn(host, project, limits, monkeypatch):
    fake = servers.ProcessLauncher((sys.executable, str(FAKE), "echo"))
    monkeypatch.setattr(consumers, "launcher", lambda: fake)
    limits(max_language_servers=1)
    path = f"/ws/projects/{project['id']}/language"
    has_place = {"before": None, "is_own": False}
    with opened(host, path) as first, opened(host, path) as second, opened(host, path) as third:
        assert turns_of(first, has_place) == [has_place]
        assert turns_of(second, {"before": 0, "is_own": False})
        turns_of(third, {"before": 1, "is_own": False})
        second.socket.close()
        turns_of(third, {"before": 0, "is_own": False})
        third.notify("initialized")  # is kept for the server
        first.socket.close()
        turns_of(third, has_place)
        third.socket.close()
    with opened(host, path) as again:
        turns_of(again, has_place)  # as soon as that server has ended


def test_one_user_of_many_has_two_and_two_that_wait(person):
    ada = [waiting.enter(person(f"ada{number}").user) for number in range(2)]
    ben = person("ben").user
    bens = [waiting.enter(ben) for _ in range(5)]
    try:
        assert [one and one.turn() for one in bens] == [
            None,
            None,
            Turn(0, is_own=True),
            Turn(1, is_own=True),
            None,
        ]
        ben.is_exempt = True
        shown = waiting.enter(ben)
        assert shown.turn() is None
        shown.give_back()
    finally:
        for one in (*ada, *bens[:4]):
            one.give_back()
