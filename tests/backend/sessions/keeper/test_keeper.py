"""The keeper: it starts executors and nothing else, and its executors are reached without a network."""

from __future__ import annotations

import json
import socket
import time
from uuid import uuid4

import pytest

from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.keeper.plan import Limits, Plan, read_plan
from backend.sessions.keeper.service import ended_at
from backend.sessions.keeper.unix_http import ask
from backend.sessions.launchers.base import UNKNOWN_EXIT
from backend.sessions.launchers.docker import DockerLauncher
from executor.manager.gate import fetch_listener
from tests.backend.sessions.conftest import spec
from tests.fakes.docker import gate_of

TOKEN = "t" * 64


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
        ("failing", "status 3 before it was ready"),
        ("liar", "status 1 before it was ready"),
        ("never", "within 0.6 s"),
        ("missing", "No such image"),
    ],
)
def test_an_executor_that_does_not_come_up_is_told_and_leaves_nothing(host_of, image, says):
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
    with pytest.raises(LaunchError, match="has an executor"):
        host.launcher.start(asked)
    assert host.launcher.running() == [asked.session_id]


def test_an_executor_that_took_too_much_memory_is_explained(host_of):
    host = host_of()
    started = host.launcher.start(session_spec())
    host.docker.end(next(iter(host.docker.containers)), 137, out_of_memory=True)
    assert host.launcher.poll(started.state) == 137
    assert "512 MB" in host.launcher.explain(started.state)


def test_the_gate_lets_each_session_in_once(host_of, folder):
    host = host_of()
    asked = session_spec()
    host.launcher.start(asked)
    gate = gate_of(folder) / "gate.sock"
    for session, token in ((asked.session_id, TOKEN), (str(uuid4()), TOKEN), ("", "")):
        with pytest.raises(PermissionError, match="does not know"):
            fetch_listener(gate, session, token)


def test_the_gate_survives_nonsense(host_of, folder):
    host = host_of()
    for nonsense in (b"", b"\n", b"[]\n", b"\xff\n", b'{"session": 1}\n', b"x" * 9000):
        with socket.socket(socket.AF_UNIX) as client:
            client.connect(str(gate_of(folder) / "gate.sock"))
            client.sendall(nonsense)
    assert host.launcher.start(session_spec()).address


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
        ("POST", "/sessions/" + str(uuid4())),
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
    # Whoever asks when somebody else has cleared up is told the same.
    host.launcher.stop(started.state, timeout_s=1)
    assert host.docker.containers == {}
    assert "256 processes" in host.launcher.explain(started.state)


def test_a_container_gets_no_more_processors_than_there_are(monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    for wanted, given in ((1.5, 1_500_000_000), (4, 2_000_000_000)):
        plan = Plan("executor:1", "gate", "stack", limits=Limits(cpus=wanted))
        assert plan.container("id", TOKEN, 7)["HostConfig"]["NanoCpus"] == given


def test_a_container_may_do_little(monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    plan = Plan("executor:1", "gate", "stack", limits=Limits(cpus=1.5, memory_mb=1024, pids=100, disk_mb=64))
    config = plan.container("id", TOKEN, 7)
    host = config["HostConfig"]
    assert config["User"] == "10001:10001"
    assert (host["NetworkMode"], host["IpcMode"]) == ("none", "private")
    assert host["ReadonlyRootfs"]
    assert not host["Privileged"]
    assert host["CapDrop"] == ["ALL"]
    no_new, seccomp = host["SecurityOpt"]
    assert (no_new, seccomp.partition("=")[0]) == ("no-new-privileges:true", "seccomp")
    assert host["Memory"] == host["MemorySwap"] == 1024 << 20
    assert (host["NanoCpus"], host["PidsLimit"]) == (1_500_000_000, 100)
    assert ["size=64m" in options for options in host["Tmpfs"].values()] == [True]
    mount = {"Type": "volume", "Source": "gate", "Target": "/run/bt-studio", "ReadOnly": True}
    assert host["Mounts"] == [mount]
    assert not {"Binds", "Devices", "CapAdd", "PortBindings", "PidMode", "VolumesFrom"} & set(host)
    assert TOKEN not in " ".join(config["Cmd"])


def test_limits_come_from_the_environment_and_wrong_ones_are_refused_by_name():
    plan = read_plan({"BT_STUDIO_SESSION_PIDS": "33"}, gate_source="/gate", stack="s")
    assert plan.limits.pids == 33
    assert plan.container("id", TOKEN, 1)["HostConfig"]["Mounts"][0]["Type"] == "bind"
    for wrong in ("many", "0", "-1", "nan", "inf"):
        with pytest.raises(ValueError, match="BT_STUDIO_SESSION_PIDS"):
            read_plan({"BT_STUDIO_SESSION_PIDS": wrong}, gate_source="gate", stack="s")


def test_dockers_times_are_read():
    assert ended_at({"FinishedAt": "1970-01-01T00:01:00.123456789Z"}) == 60
    assert ended_at({"FinishedAt": "soon"}) == 0
