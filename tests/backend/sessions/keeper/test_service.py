"""The keeper: it starts executors and nothing else, and its executors are reached without a network."""

from __future__ import annotations

import http.client
import json
import re
import socket
import stat
import time
from concurrent.futures import ThreadPoolExecutor
from uuid import uuid4

import pytest

from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.keeper.service import ended_at
from backend.sessions.keeper.unix_http import ask
from backend.sessions.launchers.base import UNKNOWN_EXIT
from backend.sessions.launchers.docker import DockerLauncher
from tests.backend.sessions.conftest import spec
from tests.e2e.server import wait_until
from tests.fakes.docker import gate_of

TOKEN = "t" * 64
DOOR = "d" * 32 + "/gate.sock"


def session_spec(**changes):
    return spec(session_id=str(uuid4()), token=TOKEN, **changes)


def test_an_executor_starts_is_reached_and_ends(host_of):
    host = host_of()
    asked = session_spec()
    started = host.launcher.start(asked)
    kind, _, path = started.address.partition(":")
    assert kind == "unix"
    with socket.socket(socket.AF_UNIX) as client:
        client.connect(path)
    assert host.launcher.poll(started.state) is None
    assert host.launcher.running() == [asked.session_id]
    host.launcher.stop(started.state, timeout_s=1)
    host.launcher.stop(started.state, timeout_s=1)
    assert host.launcher.poll(started.state) == UNKNOWN_EXIT
    assert host.docker.containers == {}
    assert host.sockets == []


@pytest.mark.parametrize(
    ("image", "says"),
    [
        ("failing", "ended before it was ready"),
        ("liar", "ended before it was ready"),
        ("never", "within 0.6 s"),
        ("missing", "No such image"),
    ],
)
def test_an_executor_that_does_not_come_up_is_reported_and_leaves_nothing(host_of, image, says):
    host = host_of(image)
    with pytest.raises(LaunchError, match=says) as caught:
        host.launcher.start(session_spec(start_timeout_s=0.6 if image == "never" else 60))
    assert ("the fake executor starts" in caught.value.hint) == (image != "missing")
    assert host.docker.containers == {}
    assert host.sockets == []


def test_a_full_host_says_so(host_of):
    host = host_of(max_sessions=1)
    first = host.launcher.start(session_spec())
    with pytest.raises(HostFullError, match="All 1 places"):
        host.launcher.start(session_spec())
    host.launcher.stop(first.state, timeout_s=1)
    host.launcher.start(session_spec())


def test_a_session_has_one_executor(host_of):
    host = host_of()
    asked = session_spec()
    host.launcher.start(asked)
    with pytest.raises(LaunchError, match="runs already"):
        host.launcher.start(asked)
    assert host.launcher.running() == [asked.session_id]


def test_an_executor_that_took_too_much_memory_is_explained(host_of):
    host = host_of()
    started = host.launcher.start(session_spec())
    host.docker.end(next(iter(host.docker.containers)), 137, out_of_memory=True)
    assert host.launcher.poll(started.state) == 137
    assert "512 MB" in host.launcher.explain(started.state)


def test_each_session_has_a_door_of_its_own_which_is_gone_when_it_has_come(host_of):
    host = host_of()
    doors = []
    for _ in range(2):
        host.launcher.start(session_spec())
        command = list(host.docker.containers.values())[-1]["Cmd"]
        doors.append(command[command.index("--gate") + 1])
    assert all(re.fullmatch(r"/run/bt-studio/[0-9a-f]{32}/gate\.sock", door) for door in doors)
    assert len(set(doors)) == 2
    assert host.doors == []
    assert stat.S_IMODE(gate_of(host.folder.parent).stat().st_mode) == 0o711


def test_a_session_that_never_comes_leaves_no_door(host_of):
    host = host_of("never")
    with pytest.raises(LaunchError, match="within"):
        host.launcher.start(session_spec(start_timeout_s=0.6))
    wait_until(lambda: host.doors == [], "the door is gone")


def test_without_a_gate_a_start_says_so(host_of):
    host = host_of(patience_s=0.2)
    host.end_gate()
    with pytest.raises(LaunchError, match="The gate does not answer"):
        host.launcher.start(session_spec())
    assert host.docker.containers == {}
    assert host.sockets == []


def test_a_gate_that_is_started_again_lets_the_session_in_that_was_on_its_way(host_of):
    host = host_of("waits")
    with ThreadPoolExecutor(1) as web:
        starting = web.submit(host.launcher.start, session_spec())
        wait_until(lambda: host.docker.containers, "the container is made")
        host.end_gate()
        assert host.doors == []
        host.start_gate()
        host.docker.go_on.set()
        assert starting.result(60).address
    assert host.doors == []


def test_a_session_whose_socket_is_gone_is_ended(host_of):
    host = host_of()
    started = host.launcher.start(session_spec())
    host.keeper.tidy(time.time())
    assert host.launcher.poll(started.state) is None
    [path] = (host.folder / "sessions").iterdir()
    path.unlink()
    host.keeper.tidy(time.time())
    assert host.launcher.poll(started.state) == 143
    assert "Its socket was removed" in host.launcher.explain(started.state)


def test_more_requests_than_there_are_places_for_are_refused_and_the_keeper_lives(host_of, monkeypatch):
    monkeypatch.setattr("backend.sessions.keeper.server.MAX_REQUESTS", 4)
    host = host_of()
    silent = [socket.socket(socket.AF_UNIX) for _ in range(40)]
    for client in silent:
        client.connect(str(host.folder / "keeper.sock"))
    # The last connection was closed without an answer: all places are taken by silent connections.
    silent[-1].settimeout(60)
    assert silent[-1].recv(1) == b""
    for client in silent:
        client.close()
    wait_until(lambda: answers(host), "the keeper answers")
    assert host.launcher.start(session_spec()).address


def answers(host):
    try:
        return ask(str(host.folder / "keeper.sock"), "GET", "/health")[0] == 200
    except (OSError, http.client.HTTPException):
        return False


@pytest.mark.parametrize(
    "body",
    [
        {},
        [],
        {"session": "../../etc", "token": TOKEN, "domain_id": 1},
        {"session": str(uuid4()), "token": "short", "domain_id": 1},
        {"session": str(uuid4()), "token": TOKEN, "domain_id": 500},
        {"session": str(uuid4()), "token": TOKEN, "domain_id": True},
        {"session": str(uuid4()), "token": TOKEN, "domain_id": 1, "timeout_s": -1},
        {"session": str(uuid4()), "token": TOKEN, "domain_id": 1, "Image": "alpine"},
        {"session": str(uuid4()), "token": TOKEN, "domain_id": 1, "HostConfig": {"Privileged": True}},
    ],
)
def test_the_keeper_takes_ids_and_tokens_and_nothing_else(host_of, body):
    host = host_of()
    status, answer = ask(str(host.folder / "keeper.sock"), "POST", "/sessions", body)
    assert (status, json.loads(answer)["code"]) == (400, "bad_request")
    assert host.docker.requests == []


@pytest.mark.parametrize(
    ("method", "target"),
    [
        ("GET", "/containers/json"),
        ("POST", "/containers/create"),
        ("DELETE", "/sessions/x"),
        ("GET", "/sessions/..%2f"),
        ("POST", "/sessions/5c355f26-58ad-4373-85ac-fcf3c2910131"),
    ],
)
def test_the_keeper_is_no_way_to_docker(host_of, method, target):
    host = host_of()
    status, _ = ask(str(host.folder / "keeper.sock"), method, target, {} if method == "POST" else None)
    assert status in {400, 404}
    assert host.docker.requests == []


def test_a_keeper_that_does_not_answer_ends_no_session(tmp_path):
    launcher = DockerLauncher(tmp_path)
    assert launcher.poll({"session": "s"}) is None
    assert launcher.running() == []
    launcher.stop({"session": "s"}, timeout_s=1)
    with pytest.raises(LaunchError, match="does not answer"):
        launcher.start(session_spec())


def test_what_ran_too_long_is_ended_and_what_ended_long_ago_removed(host_of):
    host = host_of()
    host.launcher.start(session_spec())
    name = next(iter(host.docker.containers))
    host.keeper.tidy(time.time())
    assert host.docker.containers[name]["State"]["Running"]
    host.keeper.tidy(time.time() + 2 * 3600 + 60)
    assert not host.docker.containers[name]["State"]["Running"]
    host.keeper.tidy(time.time())
    assert name in host.docker.containers
    host.docker.end(name, 0, at=time.time() - 7200)
    host.keeper.tidy(time.time())
    assert host.docker.containers == {}


def test_a_storm_of_processes_is_ended_from_outside(host_of):
    host = host_of()
    started = host.launcher.start(session_spec())
    name = next(iter(host.docker.containers))
    host.docker.processes[name] = 256
    host.keeper.end_crowded()
    host.docker.processes[name] = 200
    host.keeper.end_crowded()
    assert host.launcher.poll(started.state) is None
    host.docker.processes[name] = 256
    host.keeper.end_crowded()
    host.keeper.end_crowded()
    assert host.launcher.poll(started.state) == 137
    assert "256 processes" in host.launcher.explain(started.state)
    # A caller gets the same answer after another one has removed the container.
    host.launcher.stop(started.state, timeout_s=1)
    assert host.docker.containers == {}
    assert "256 processes" in host.launcher.explain(started.state)


def test_dockers_times_are_read():
    assert ended_at({"FinishedAt": "1970-01-01T00:01:00.123456789Z"}) == 60
    assert ended_at({"FinishedAt": "soon"}) == 0
