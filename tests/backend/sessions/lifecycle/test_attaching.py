"""Sessions that follow programs: their executor may be started before them."""

from __future__ import annotations

import pytest

from backend.sessions.launchers.base import WARM
from backend.sessions.lifecycle import attaching, writes
from backend.sessions.models import Session
from tests.backend.sessions.conftest import children
from tests.backend.sessions.lifecycle.test_writes import launched

pytestmark = pytest.mark.django_db(transaction=True)


@pytest.fixture
def prepare(api, monkeypatch):
    """Asks for an executor ahead, and waits for the start."""

    def ask():
        at_once = type("AtOnce", (), {"submit": lambda _, work: work()})()
        with monkeypatch.context() as now:
            now.setattr(writes, "workers", lambda: at_once)
            api.post("sessions/attached/prepare", expect=204)

    return ask


def test_a_session_takes_the_executor_that_was_prepared_and_its_token(api, fake_manager, prepare):
    fake_manager("echo")
    assert attaching.may_attach()
    prepare()
    assert len(children()) == 1
    began = api.post("sessions/attached", {"address": "robot.local"})
    launched(began["id"])
    made = Session.objects.get()
    assert made.state == "ready"
    assert len(children()) == 1
    assert writes.manager_token(made) == writes.token_of(made.launcher_state[WARM])
    api.delete(f"sessions/{began['id']}")
    assert children() == []


def test_nothing_is_prepared_without_a_place_and_a_failure_stays_here(prepare, fake_manager, monkeypatch):
    fake_manager("failing")
    prepare()
    fake_manager("echo")
    monkeypatch.setattr(writes, "places_left", lambda _states: 0)
    prepare()
    assert children() == []
