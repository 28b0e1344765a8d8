"""A host is cut off and comes back: its sessions fail with the reason, and no session runs twice."""

from __future__ import annotations

import pytest

from backend.sessions import maintenance
from backend.sessions.launchers.hosts import LOCAL, lost_reason
from backend.sessions.lifecycle import writes
from backend.sessions.models import Session
from tests.backend.sessions.lifecycle.test_writes import launched
from tests.e2e.server import wait_until

pytestmark = pytest.mark.django_db(transaction=True)


class Clock:
    """The clock of the web server, which the test advances."""

    def __init__(self):
        self.now_s = 0.0

    def __call__(self):
        return self.now_s

    def rounds(self, number):
        """Maintains the sessions once in nine seconds."""
        for _ in range(number):
            self.now_s += 9
            maintenance.maintain()


@pytest.mark.parametrize("silence_s", [2, 120])
def test_no_session_runs_twice_when_a_host_is_cut_off_and_comes_back(  # noqa: PLR0917 - fixtures
    silence_s, api, project, host_of, launcher_of, monkeypatch
):
    clock = Clock()
    local = host_of(1, BT_STUDIO_MAX_SESSIONS="1")
    further = host_of(2, BT_STUDIO_MAX_SESSIONS="5")
    launcher = launcher_of(local, further, clock=clock)
    monkeypatch.setattr(writes, "launcher", lambda: launcher)
    first = api.post(f"projects/{project['id']}/session")["id"]
    launched(first)
    clock.rounds(2)
    assert api.get(f"sessions/{first}")["state"] == "ready"
    assert Session.objects.get().host == str(further.address)
    further.restart_keeper(BT_STUDIO_KEEPER_SILENCE_S=str(silence_s))

    further.cut()
    monkeypatch.setattr("backend.sessions.launchers.relayed.CONNECT_S", 0.5)
    clock.rounds(3)
    assert api.get(f"sessions/{first}")["state"] == "ready"
    clock.rounds(2)
    failed = api.get(f"sessions/{first}")
    assert (failed["state"], failed["error"]) == ("failed", lost_reason(str(further.address)))
    second = api.post(f"projects/{project['id']}/session")["id"]
    launched(second)
    assert second != first
    assert Session.objects.get(id=second).host == LOCAL
    if silence_s == 2:
        wait_until(lambda: further.sessions == set(), "the keeper has ended what nobody maintains")
    else:
        assert further.sessions == {first}

    monkeypatch.setattr("backend.sessions.launchers.relayed.CONNECT_S", 60)
    further.heal()
    clock.rounds(1)
    assert further.sessions == set()
    assert launcher.running() == [second]
    assert api.get(f"sessions/{second}")["state"] == "ready"
    api.delete(f"sessions/{second}")
    # The host is used again.
    third = api.post(f"projects/{project['id']}/session")["id"]
    launched(third)
    assert Session.objects.get(id=third).host == str(further.address)
    api.delete(f"sessions/{third}")
