"""Sessions and tools on several hosts, whose programs are real and whose Docker runs no containers."""

from __future__ import annotations

from uuid import uuid4

import pytest

from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.launchers.base import UNKNOWN_EXIT
from backend.sessions.launchers.hosts import LOCAL, lost_reason
from backend.sessions.manager.address import open_sync_socket
from tests.backend.sessions.conftest import spec
from tests.backend.sessions.hosts.conftest import authority, host_of, launcher_of
from tests.e2e.server import wait_until

TOKEN = "t" * 64


def session_spec(**changes):
    return spec(session_id=str(uuid4()), token=TOKEN, **changes)


def places(number, **more):
    return {"BT_STUDIO_MAX_SESSIONS": str(number), "BT_STUDIO_MAX_TOOLS": str(number), **more}


def name_of(host):
    return str(host.address)


def test_sessions_go_where_most_places_are_free(host_of, launcher_of):
    small, large = host_of(1, **places(1)), host_of(2, **places(3))
    launcher = launcher_of(small, large)
    asked = [session_spec() for _ in range(4)]
    started = [launcher.start(each) for each in asked]
    assert [one.host for one in started] == [name_of(large), name_of(large), LOCAL, name_of(large)]
    assert started[0].address == f"tls://{large.address}/{asked[0].session_id}"
    assert started[2].address.startswith("unix:")
    assert sorted(launcher.running()) == sorted(each.session_id for each in asked)
    for one, each in zip(started, asked, strict=True):
        assert launcher.poll(one.state) is None
        assert launcher.state_of(each.session_id) == one.state
    with pytest.raises(HostFullError, match="all hosts"):
        launcher.start(session_spec())
    for one in started:
        launcher.stop(one.state, timeout_s=1)
    assert launcher.running() == []
    assert small.sessions | large.sessions == set()
    assert launcher.state_of(asked[0].session_id)["host"] == LOCAL


def test_a_real_manager_on_another_host_answers(host_of, launcher_of):
    local, further = host_of(1, **places(0)), host_of(2, BT_STUDIO_EXECUTOR_IMAGE="manager")
    launcher = launcher_of(local, further)
    started = launcher.start(session_spec())
    assert started.host == name_of(further)
    headers = {"Authorization": f"Bearer {TOKEN}"}
    with open_sync_socket(started.address, "control", additional_headers=headers, open_timeout=60) as socket:
        assert '"command"' in socket.recv(timeout=60)
    launcher.stop(started.state, timeout_s=1)
    wait_until(lambda: launcher.poll(started.state) is not None, "the manager has ended")


def test_tools_are_found_where_they_run(host_of, launcher_of):
    one, two = host_of(1, **places(1)), host_of(2, **places(2))
    launcher = launcher_of(one, two)
    first, second, third = (str(uuid4()) for _ in range(3))
    opened = {made: launcher.open_tools(made, TOKEN, timeout_s=60) for made in (first, second, third)}
    assert sum(address.startswith("tls:") for address in opened.values()) == 2
    # Another web server finds the same ones.
    again = launcher_of(one, two)
    assert {made: again.open_tools(made, TOKEN, timeout_s=60) for made in opened} == opened
    with pytest.raises(HostFullError):
        launcher.open_tools(str(uuid4()), TOKEN, timeout_s=60)


def test_a_host_that_is_gone_is_passed_over(host_of, launcher_of):
    local, further = host_of(1, **places(1)), host_of(2, **places(5))
    launcher = launcher_of(local, further)
    further.kill("relay")
    assert launcher.start(session_spec()).host == LOCAL
    with pytest.raises(HostFullError):
        launcher.start(session_spec())
    local.kill("keeper")
    with pytest.raises(LaunchError, match="on any host"):
        launcher.start(session_spec())
    assert launcher.running() == []


def test_a_start_whose_answer_is_lost_is_not_tried_elsewhere(host_of, launcher_of):
    local = host_of(1, **places(1))
    further = host_of(2, **places(5, BT_STUDIO_EXECUTOR_IMAGE="waits"))
    launcher = launcher_of(local, further)

    asked = session_spec(start_timeout_s=60)
    further.docker.on_start = lambda: further.kill("relay")
    with pytest.raises(LaunchError, match="does not answer"):
        launcher.start(asked)
    assert local.sessions == set()
    # It may run there, and is found when the host is reached again.
    further.docker.go_on.set()
    further.start("relay")
    wait_until(further.answers, "the host answers")
    wait_until(lambda: launcher.running() == [asked.session_id], "the executor runs")
    assert launcher.state_of(asked.session_id)["host"] == name_of(further)


def test_sessions_of_a_host_that_was_taken_off_the_list_have_ended(host_of, launcher_of):
    local, further = host_of(1, **places(0)), host_of(2)
    started = launcher_of(local, further).start(session_spec())
    launcher = launcher_of(local, host_of(3))
    assert launcher.poll(started.state) == UNKNOWN_EXIT
    assert "is not in BT_STUDIO_EXECUTOR_HOSTS any more" in launcher.explain(started.state)
    launcher.stop(started.state, timeout_s=1)
    assert launcher.is_reached(started.state)


def test_a_host_is_lost_and_returns(host_of, launcher_of):
    local, further = host_of(1, **places(0)), host_of(2)
    now_s = [0.0]
    launcher = launcher_of(local, further, clock=lambda: now_s[0])
    started = launcher.start(session_spec())
    assert launcher.look_at_hosts().lost == {}
    assert launcher.is_reached(started.state)
    further.kill("relay")
    for _ in range(4):
        now_s[0] += 9
        news = launcher.look_at_hosts()
    assert news.lost == {name_of(further): lost_reason(name_of(further))}
    assert not news.has_returned
    assert launcher.poll(started.state) is None
    assert not launcher.is_reached(started.state)
    further.start("relay")
    wait_until(further.answers, "the host answers")
    assert launcher.look_at_hosts().has_returned
    assert launcher.look_at_hosts().lost == {}
    assert launcher.running() == [started.state["session"]]


__all__ = ["authority", "host_of", "launcher_of"]
