"""The keeper's containers with users' tools, without Docker."""

from __future__ import annotations

import json
import socket
import threading
import time
from uuid import uuid4

import pytest

from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.keeper.plan import Plan, read_plan
from backend.sessions.keeper.unix_http import ask

TOKEN = "t" * 64
DOOR = "d" * 32 + "/gate.sock"


def opened(host, tools_id=None):
    return host.launcher.open_tools(tools_id or str(uuid4()), TOKEN, timeout_s=60)


def names(host):
    return [name for name, one in host.docker.containers.items() if one["State"]["Running"]]


def test_a_users_tools_are_started_once_and_found_again(host_of):
    host = host_of()
    tools_id = str(uuid4())
    paths = []
    pages = [threading.Thread(target=lambda: paths.append(opened(host, tools_id))) for _ in range(4)]
    for page in pages:
        page.start()
    for page in pages:
        page.join()
    assert len(paths) == 4
    assert len(set(paths)) == 1
    assert names(host) == [f"stack-tools-{tools_id}"]
    with socket.socket(socket.AF_UNIX) as client:
        client.connect(paths[0].removeprefix("unix:"))
    assert host.launcher.running() == [], "tools are no session, and no orphan of one"


def test_tools_that_have_ended_are_started_again(host_of):
    host = host_of()
    tools_id = str(uuid4())
    first = opened(host, tools_id)
    host.docker.end(f"stack-tools-{tools_id}", 0)
    assert opened(host, tools_id) == first
    assert names(host) == [f"stack-tools-{tools_id}"]


def test_a_full_host_says_so_and_one_that_is_there_is_still_found(host_of):
    host = host_of(max_sessions=1)
    tools_id = str(uuid4())
    opened(host, tools_id)
    with pytest.raises(HostFullError, match="All 1 places for editors"):
        opened(host)
    assert opened(host, tools_id)


def test_tools_that_do_not_come_up_are_reported_and_leave_nothing(host_of):
    host = host_of("failing")
    with pytest.raises(LaunchError, match="ended before it was ready"):
        opened(host)
    assert host.docker.containers == {}
    assert host.sockets == []


def test_what_has_ended_is_removed_and_what_ran_too_long_ended(host_of):
    host = host_of()
    old, new = str(uuid4()), str(uuid4())
    opened(host, old)
    opened(host, new)
    host.docker.end(f"stack-tools-{old}", 0)
    host.tools.tidy(time.time())
    assert list(host.docker.containers) == [f"stack-tools-{new}"]
    assert host.sockets == [f"{new}.sock"]
    host.tools.tidy(time.time() + 25 * 3600)
    assert names(host) == []


@pytest.mark.parametrize(
    "body",
    [
        {},
        {"tools": "../x", "token": TOKEN},
        {"tools": str(uuid4()), "token": "short"},
        {"tools": str(uuid4()), "token": TOKEN, "timeout_s": 1e9},
        {"tools": str(uuid4()), "token": TOKEN, "Image": "alpine"},
    ],
)
def test_the_keeper_takes_an_id_and_a_token_and_nothing_else(host_of, body):
    host = host_of()
    status, answer = ask(str(host.folder / "keeper.sock"), "POST", "/tools", body)
    assert (status, json.loads(answer)["code"]) == (400, "bad_request")
    assert host.docker.requests == []


def test_tools_may_do_as_little_as_an_executor_and_use_less():
    plan = Plan("executor:1", "gate", "stack")
    tools, session = (
        plan.tools("id", TOKEN, DOOR)["HostConfig"],
        plan.container("id", TOKEN, 7, DOOR)["HostConfig"],
    )
    limits = {"Memory", "MemorySwap", "NanoCpus", "PidsLimit", "ShmSize", "Tmpfs"}
    assert {key: value for key, value in tools.items() if key not in limits} == {
        key: value for key, value in session.items() if key not in limits
    }
    assert tools["Memory"] < session["Memory"]
    assert tools["PidsLimit"] < session["PidsLimit"]
    assert plan.tools("id", TOKEN, DOOR)["User"] == "10001:10001"


def test_their_limits_come_from_the_environment():
    given = {"BT_STUDIO_TOOLS_MEMORY_MB": "900", "BT_STUDIO_TOOLS_GRACE_S": "30"}
    plan = read_plan(given, gate_source="gate", stack="s")
    assert (plan.tools_limits.memory_mb, plan.tools_limits.cpus, plan.tools_grace_s) == (900, 1, 30)
    assert plan.limits.memory_mb == 2048
    with pytest.raises(ValueError, match="BT_STUDIO_TOOLS_PIDS"):
        read_plan({"BT_STUDIO_TOOLS_PIDS": "many"}, gate_source="gate", stack="s")
