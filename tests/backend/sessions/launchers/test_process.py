"""The launcher contract, and its process back end against a zoo of managers."""

from __future__ import annotations

import json
import os
import signal
import threading
import time
import urllib.request
from contextlib import suppress

import psutil
import pytest

from backend.sessions.errors import LaunchError
from backend.sessions.launchers import process
from backend.sessions.launchers.base import UNKNOWN_EXIT, WARM
from backend.sessions.launchers.process import RUNS, ProcessLauncher
from tests.backend.sessions.conftest import children, spec


def is_alive(process):
    return process.is_running() and process.status() != psutil.STATUS_ZOMBIE


def test_a_manager_starts_runs_and_ends(launcher_of):
    launcher = launcher_of("echo")
    started = launcher.start(spec())
    assert launcher.poll(started.state) is None
    launcher.stop(started.state, timeout_s=5)
    assert launcher.poll(started.state) is not None
    assert not psutil.pid_exists(started.state["pid"])
    launcher.stop(started.state, timeout_s=5)


def test_each_session_has_a_folder_for_its_recordings(launcher_of, tmp_path):
    launcher = launcher_of("echo")
    assert launcher.recordings is None
    launcher.recordings = tmp_path
    arguments = psutil.Process(launcher.start(spec()).state["pid"]).cmdline()
    assert arguments[arguments.index("--recordings") + 1] == str(tmp_path / spec().session_id / RUNS)


def ordered(launcher, made_id):
    """Waits for the order that the fake manager has read."""
    log = launcher.log_folder / f"{made_id}.log"
    for_s = time.monotonic() + 60
    while "target" not in log.read_text():
        assert time.monotonic() < for_s, log.read_text()
        time.sleep(0.01)
    return json.loads(log.read_text().splitlines()[-1])


def test_a_manager_gets_the_address_of_the_program_that_it_follows(launcher_of, tmp_path):
    launcher = launcher_of("echo")
    started = launcher.start(spec(target="robot:1667"))
    assert WARM not in started.state
    assert ordered(launcher, "s1") == {"target": "robot:1667", "recordings": ""}
    launcher.recordings = tmp_path
    launcher.start(spec(session_id="s2", target="robot:1668"))
    told = {"target": "robot:1668", "recordings": str(tmp_path / "s2" / RUNS)}
    assert ordered(launcher, "s2") == told


def test_a_prepared_manager_is_taken_once_and_by_a_session_with_a_target(launcher_of):
    launcher = launcher_of("echo")
    launcher.prepare(spec(session_id="ahead", token="other"))
    launcher.prepare(spec(session_id="again"))  # one waits already
    assert len(children()) == 1
    assert WARM not in launcher.start(spec()).state
    taken = launcher.start(spec(session_id="s2", target="robot:1667"))
    assert taken.state[WARM] == "ahead"
    assert ordered(launcher, "ahead")["target"] == "robot:1667"
    assert psutil.Process(taken.state["pid"]).environ()["BT_STUDIO_MANAGER_TOKEN"] == "other"
    assert WARM not in launcher.start(spec(session_id="s3", target="robot:1668")).state
    assert len(children()) == 3


def test_a_prepared_manager_that_has_ended_or_is_old_is_left(launcher_of, monkeypatch):
    launcher = launcher_of("echo")
    launcher.prepare(spec(session_id="ahead"))
    [spare] = children()
    spare.kill()
    os.waitid(os.P_PID, spare.pid, os.WEXITED | os.WNOWAIT)
    assert WARM not in launcher.start(spec(target="robot:1667")).state
    monkeypatch.setattr(process, "SPARE_S", 0.0)
    launcher.prepare(spec(session_id="old"))
    assert WARM not in launcher.start(spec(session_id="s2", target="robot:1667")).state


def test_where_none_can_be_prepared_a_session_starts_its_own(launcher_of):
    launcher = launcher_of("failing")
    with pytest.raises(LaunchError):
        launcher.prepare(spec(session_id="ahead"))
    with pytest.raises(LaunchError, match="exit status 3"):
        launcher.start(spec(session_id="s2", target="robot:1667"))
    assert (launcher.log_folder / "s2.log").exists()


def test_the_state_is_json_and_holds_no_secret(launcher_of):
    started = launcher_of("echo").start(spec())
    assert "t0ken" not in json.dumps(started.state)


def test_the_child_gets_its_token_and_domain_and_not_our_secrets(launcher_of, monkeypatch):
    monkeypatch.setenv("BT_STUDIO_TOKEN", "ours")
    monkeypatch.setenv("BT_STUDIO_HOLD_MINUTES", "5")
    monkeypatch.setenv("BT_STUDIO_APPLICATION_MEMORY_MB", "512")
    started = launcher_of("echo").start(spec(ros_domain_id=77))
    environment = psutil.Process(started.state["pid"]).environ()
    assert environment["BT_STUDIO_MANAGER_TOKEN"] == "t0ken"
    assert (environment["ROS_DOMAIN_ID"], environment["ROS_AUTOMATIC_DISCOVERY_RANGE"]) == ("77", "LOCALHOST")
    assert "BT_STUDIO_TOKEN" not in environment
    assert environment["BT_STUDIO_HOLD_MINUTES"] == "5"
    assert environment["BT_STUDIO_APPLICATION_MEMORY_MB"] == "512"
    assert "t0ken" not in " ".join(psutil.Process(started.state["pid"]).cmdline())


def test_another_launcher_finds_the_process_by_its_state(launcher_of):
    first, second = launcher_of("echo"), launcher_of("echo")
    state = first.start(spec()).state
    assert second.poll(state) is None
    second.stop(state, timeout_s=5)
    assert first.poll(state) is not None
    assert second.poll(state) == UNKNOWN_EXIT


def test_a_later_process_with_the_same_number_is_not_ours(launcher_of):
    launcher = launcher_of("echo")
    state = {"pid": os.getpid(), "created": 1.0}
    assert launcher.poll(state) == UNKNOWN_EXIT
    launcher.stop(state, timeout_s=1)


@pytest.mark.parametrize(
    ("kind", "says"),
    [("failing", "exit status 3"), ("never", "within 0.7 s"), ("mute", "not ready|ended before")],
)
def test_a_manager_that_does_not_come_up_is_reported_and_leaves_nothing(launcher_of, kind, says):
    with pytest.raises(LaunchError, match=says) as caught:
        launcher_of(kind).start(spec(start_timeout_s=0.7 if kind == "never" else 60))
    assert caught.value.hint == "the fake manager starts" or kind == "never"
    assert children() == []


def test_a_slow_manager_is_waited_for(launcher_of):
    assert launcher_of("slow").start(spec()).address


def test_a_manager_that_does_not_want_to_end_is_killed_with_its_children(launcher_of):
    launcher = launcher_of("stubborn")
    state = launcher.start(spec()).state
    family = psutil.Process(state["pid"]).children(recursive=True)
    assert len(family) == 1
    launcher.stop(state, timeout_s=0.5)
    assert not any(is_alive(member) for member in family)


def test_a_program_that_cannot_be_started_is_reported(launcher_of, tmp_path):
    launcher = launcher_of("echo", program=str(tmp_path / "missing"))
    with pytest.raises(LaunchError, match="could not be started"):
        launcher.start(spec())


def test_managers_survive_the_thread_that_asked_for_them(launcher_of):
    launcher = launcher_of("echo")
    started = []
    thread = threading.Thread(target=lambda: started.append(launcher.start(spec())))
    thread.start()
    thread.join()
    assert launcher.poll(started[0].state) is None
    with suppress(Exception):
        urllib.request.urlopen(f"http://{started[0].address}")
    assert launcher.poll(started[0].state) is None


def test_a_killed_manager_is_seen_with_its_signal(launcher_of):
    launcher = launcher_of("echo")
    state = launcher.start(spec()).state
    os.kill(state["pid"], signal.SIGKILL)
    os.waitid(os.P_PID, state["pid"], os.WEXITED | os.WNOWAIT)
    assert launcher.poll(state) == -signal.SIGKILL


def test_it_says_that_its_executors_end_with_the_server(launcher_of):
    launcher = launcher_of("echo")
    assert isinstance(launcher, ProcessLauncher)
    assert (launcher.name, launcher.survives_server) == ("process", False)


def test_a_stopped_manager_is_killed_without_waiting_for_it(launcher_of):
    launcher = launcher_of("echo")
    started = launcher.start(spec())
    os.kill(started.state["pid"], signal.SIGSTOP)
    launcher.stop(started.state, timeout_s=3600)  # it would wait for all of it
    assert not psutil.pid_exists(started.state["pid"])
