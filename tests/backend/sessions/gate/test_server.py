"""The gate as a process: no connection can end it, or keep a session out."""

from __future__ import annotations

import signal
import socket
import stat
import time
from pathlib import Path
from typing import Any

import psutil
import pytest

from backend.sessions.gate.callers import Callers
from backend.sessions.gate.doors import Doors
from backend.sessions.gate.errors import GateError
from backend.sessions.gate.server import GateServer, Limits
from tests.backend.sessions.gate.conftest import TOKEN, fetch, show
from tests.e2e.server import wait_until

LISTEN = (b"listen\n", 1)
REFUSED = (b"refused\n", 0)
DESCRIPTORS = 40


def is_served(take):
    try:
        caller = take()
        show(caller, session="n0")
        return fetch(caller) == LISTEN
    except OSError:  # it was too slow for the gate; the next one may not be
        return False


def is_closed(caller):
    try:
        return caller.recv(1) == b""
    except ConnectionResetError:
        return True


def test_a_token_opens_its_door_once_and_the_door_is_gone(gate):
    door, ours = gate.open_door()
    [caller] = gate.connect(gate.entrance(door))
    show(caller)
    assert fetch(caller) == LISTEN
    assert door.wait(60)
    assert list(gate.doors.iterdir()) == []
    with pytest.raises(FileNotFoundError):
        gate.connect(gate.entrance(door))
    assert ours.fileno() >= 0


@pytest.mark.parametrize(
    "said",
    [
        {"token": "wrong"},
        {"session": "another"},
        {"session": "", "token": ""},
    ],
)
def test_anything_else_is_refused_and_the_session_still_comes(gate, said):
    door, _ = gate.open_door()
    stranger, own = gate.connect(gate.entrance(door), 2)
    show(stranger, **said)
    assert fetch(stranger) == REFUSED
    show(own)
    assert fetch(own) == LISTEN


@pytest.mark.parametrize(
    "nonsense", [b"\n", b"[]\n", b"\xff\n", b'{"session": 1}\n', b"[" * 4000 + b"\n", b"x" * 9000]
)
def test_nonsense_ends_its_connection_alone(gate, nonsense):
    door, _ = gate.open_door()
    for path in (gate.entrance(door), gate.control):
        [caller] = gate.connect(path)
        caller.sendall(nonsense)
        words = caller.recv(64) if nonsense.endswith(b"\n") else b""
        assert words in {b"", b"refused\n", b"bad\n"}
    [own] = gate.connect(gate.entrance(door))
    show(own)
    assert fetch(own) == LISTEN


def test_the_root_cannot_be_listed_and_left_doors_are_removed(stopped_gate):
    left = stopped_gate.doors / ("0" * 32)
    left.mkdir(parents=True)
    stopped_gate.start()
    assert not left.exists()
    assert stat.S_IMODE(stopped_gate.doors.stat().st_mode) == 0o711
    door, _ = stopped_gate.open_door()
    assert stat.S_IMODE((stopped_gate.doors / door.name).stat().st_mode) == 0o711


def test_a_door_is_open_as_long_as_the_keeper_keeps_it(gate):
    door, _ = gate.open_door()
    [waiting] = gate.connect(gate.entrance(door))
    door.close()
    assert is_closed(waiting)
    wait_until(lambda: list(gate.doors.iterdir()) == [], "the door is gone")


def test_a_thousand_that_say_nothing_take_neither_threads_nor_descriptors_nor_the_next_ones_time(gate):
    door, _ = gate.open_door()
    other, _ = gate.open_door("other")
    silent = gate.connect(gate.entrance(door), 1000)
    process = psutil.Process(gate.process.pid)
    assert process.num_threads() == 1
    # Those of the door, those of the keeper, and what a program has anyhow.
    wait_until(lambda: process.num_fds() < 40, "the oldest gave way")
    assert is_closed(silent[0])
    assert gate.check() == 0
    for name, one in (("other", other), ("s", door)):
        [caller] = gate.connect(gate.entrance(one))
        show(caller, session=name)
        assert fetch(caller) == LISTEN
        assert one.wait(60)


def test_a_flood_beside_keeps_no_session_out(gate):
    flooded, _ = gate.open_door()
    with_flood = [gate.open_door(f"n{number}") for number in range(20)]
    for number, (door, _) in enumerate(with_flood):
        gate.connect(gate.entrance(flooded), 50)
        [caller] = gate.connect(gate.entrance(door))
        gate.connect(gate.entrance(flooded), 50)
        show(caller, session=f"n{number}")
        assert fetch(caller) == LISTEN
    [own] = gate.connect(gate.entrance(flooded))
    show(own)
    assert fetch(own) == LISTEN


def test_out_of_descriptors_the_oldest_give_way_and_the_session_comes(stopped_gate):
    stopped_gate.start(descriptors=DESCRIPTORS)
    doors = [stopped_gate.open_door(f"n{number}")[0] for number in range(6)]
    for _ in range(10):
        for door in doors:
            stopped_gate.connect(stopped_gate.entrance(door), 8)
    for number, door in enumerate(doors):
        [caller] = stopped_gate.connect(stopped_gate.entrance(door))
        show(caller, session=f"n{number}")
        assert fetch(caller) == LISTEN
        assert door.wait(60)
    assert stopped_gate.check() == 0


def test_with_no_descriptor_to_spare_it_backs_off_and_serves_when_there_is_one(stopped_gate):
    stopped_gate.start(descriptors=DESCRIPTORS)
    doors: list[Any] = []
    # It refuses, or has none left to accept with.
    with pytest.raises(GateError, match=r"no descriptors|does not answer"):  # noqa: PT012 - after how many?
        while len(doors) < DESCRIPTORS:
            doors.append(stopped_gate.open_door(f"n{len(doors)}", timeout_s=0.5)[0])
    waiting = stopped_gate.connect(stopped_gate.entrance(doors[0]), 3)
    assert stopped_gate.process.poll() is None
    for door in doors[1:]:
        door.close()
    entrance = stopped_gate.entrance(doors[0])
    wait_until(
        lambda: is_served(lambda: waiting.pop() if waiting else stopped_gate.connect(entrance)[0]),
        "the door is served",
    )
    assert stopped_gate.check() == 0


def test_the_health_check_fails_where_nobody_accepts(gate):
    assert gate.check() == 0
    gate.process.send_signal(signal.SIGSTOP)
    assert gate.check() == 1
    gate.process.send_signal(signal.SIGCONT)
    assert gate.check() == 0
    gate.process.kill()
    gate.process.wait()
    assert gate.check() == 1


def test_a_door_is_opened_again_by_the_next_gate_under_its_name(gate):
    door, _ = gate.open_door()
    gate.process.kill()
    gate.process.wait()
    gate.start()
    wait_until(lambda: door.wait(0.1) or gate.entrance(door).exists(), "the door is open again")
    [caller] = gate.connect(gate.entrance(door))
    show(caller)
    assert fetch(caller) == LISTEN
    assert door.wait(60)


def test_the_gate_can_start_nothing_and_call_nobody(gate):
    status = (Path("/proc") / str(gate.process.pid) / "status").read_text()
    assert "Seccomp:\t2\n" in status
    assert "NoNewPrivs:\t1\n" in status


def test_one_gate_serves_a_folder(gate):
    with pytest.raises(GateError, match="gate_runs"):
        Doors(gate.doors)


def test_a_folder_of_somebody_else_is_refused_with_a_hint(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(GateError, match=r"gate_folder: .*The volume must belong"):
        Doors(tmp_path / "file")


class Clock:
    def __init__(self):
        self.now_s = 0.0

    def __call__(self):
        return self.now_s


@pytest.fixture
def stepped(stopped_gate: Any) -> Any:
    """A gate whose rounds and time the test controls."""
    clock = Clock()
    server = GateServer(Doors(stopped_gate.doors), stopped_gate.control, Limits(doors=2), clock)
    stopped_gate.clock = clock
    stopped_gate.step = lambda: server.step(0)
    yield stopped_gate
    server.end()
    server.serve()


def opened(stepped: Any, name: str):
    """A door of the stepped gate, opened as the keeper does; the answer is in the connection."""
    [ours] = stepped.connect(stepped.control)
    asked = f'{{"door": "{name}", "session": "s", "token": "{TOKEN}"}}\n'.encode()
    with socket.socket() as handed:
        socket.send_fds(ours, [asked], [handed.fileno()])
    stepped.step()
    return ours


def test_each_connection_has_a_deadline_and_each_door(stepped):
    name = "a" * 32
    keeper = opened(stepped, name)
    assert keeper.recv(64) == b"open\n"
    [slow] = stepped.connect(stepped.doors / name / "gate.sock")
    slow.sendall(b'{"session": ')
    stepped.step()
    stepped.clock.now_s = 4.9
    stepped.step()
    slow.sendall(b" ")
    stepped.clock.now_s = 5
    stepped.step()
    assert is_closed(slow)
    stepped.clock.now_s = 600
    stepped.step()
    assert is_closed(keeper)
    assert list(stepped.doors.iterdir()) == []


def test_doors_are_bounded_and_each_is_opened_once(stepped):
    keepers = [opened(stepped, character * 32) for character in "aab"]
    assert [one.recv(64) for one in keepers] == [b"open\n", b"bad\n", b"open\n"]
    assert opened(stepped, "c" * 32).recv(64) == b"full\n"
    keepers[0].close()
    stepped.step()
    assert opened(stepped, "c" * 32).recv(64) == b"open\n"


@pytest.mark.parametrize("name", ["", "a" * 31, "A" * 32, "../" + "a" * 29, "a" * 32 + "\\n"])
def test_a_door_has_the_name_of_a_door(stepped, name):
    assert opened(stepped, name).recv(64) == b"bad\n"


def test_the_keeper_must_send_a_socket_along(stepped):
    [keeper] = stepped.connect(stepped.control)
    keeper.sendall(f'{{"door": "{"a" * 32}", "session": "s", "token": "{TOKEN}"}}\n'.encode())
    stepped.step()
    assert keeper.recv(64) == b"failed\n"


def test_whose_door_is_fullest_gives_way():
    class Named:
        def __init__(self, door):
            self.door, self.deadline_s = door, time.monotonic()

    callers: Any = Callers(per_door=3, in_all=4)
    first = [Named("a") for _ in range(3)]
    [other, another] = [Named("b"), Named("b")]
    for one in (*first, other):
        assert callers.add(one) == []
    assert callers.add(Named("a")) == [first[0]]
    assert callers.add(another) == [first[1]]
    assert (len(callers), other in callers, first[2] in callers) == (4, True, True)
