"""Random projects in random worlds are taken back to a random moment, and do from there what they did.

Two processes make each run again. One is alone: no recorder, no viewers. The other one is at work as in a
session: it is recorded, viewers come and go, and its speed changes. Both are compared with the first run by
the fingerprints of their ticks (poses, statuses, blackboard with a hash of the bytes of all topics), by what
actions print, and by the state of the world in the end.
"""

from __future__ import annotations

import itertools
import random
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import msgspec
import pytest
from msgspec import structs

from executor import child_messages
from executor.child_messages import ForWorld, StartApplication
from executor.manager.archive import unpack
from executor.replay_messages import FINGERPRINT_BYTES, Replay
from tests.budget import count
from tests.executor.exact.exact_runs import ExactRun, start_message
from tests.executor.exact.random_projects import RandomProject, random_project

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = pytest.mark.simulation

HOLDING_STATE: Final = {"Drive", "Late", "Ask", "Walk", "Fetch", "Sleep", "Delay", "Timeout"}
VIEWED: Final = ("poses", "view", "camera")
SPEEDS: Final = (0.0, 5.0, 10.0)
FEW: Final = 12
# At least so many ticks are made again after a run was taken back.
TICKS_LEFT: Final = 10


@contextmanager
def unpacked(project: RandomProject, seed: int) -> Iterator[StartApplication]:
    with tempfile.TemporaryDirectory() as folder:
        unpack(project.app, Path(folder))
        yield start_message(Path(folder), seed, project.universe, project.robot)


@contextmanager
def at_work(start: StartApplication) -> Iterator[ExactRun]:
    """A run with a recorder; what it has recorded is not empty."""
    with tempfile.TemporaryDirectory() as folder:
        yield ExactRun(start, Path(folder))
        assert any(path.stat().st_size for path in Path(folder).rglob("*.mcap"))


def disturb(run: ExactRun, chance: random.Random) -> None:
    """A viewer comes or goes, or the speed changes: nothing of it is an input."""
    stream = chance.choice(VIEWED)
    client = f"viewer{chance.randrange(3)}"
    run.tell(
        ForWorld(
            chance.choice(
                [
                    child_messages.Subscribe(client, stream, width=160),  # type: ignore[arg-type]
                    child_messages.Unsubscribe(client, stream),  # type: ignore[arg-type]
                    child_messages.SetSpeed(chance.choice(SPEEDS)),
                ]
            )
        )
    )


def enter(run: ExactRun, chance: random.Random) -> None:
    """A person does something to the run."""
    match chance.randrange(4):
        case 0:
            run.tell(ForWorld(child_messages.Teleop(chance.uniform(-0.3, 0.3), chance.uniform(-1.0, 1.0))))
        case 1:
            run.pause()
            pose = (chance.uniform(-1, 1), chance.uniform(-1, 1), 0.05, 0.0, 0.0, chance.uniform(-3, 3))
            run.tell(ForWorld(child_messages.MoveBody(id="robot", pose=pose)))
        case 2:
            run.tell(child_messages.SetTickRate(tick_hz=chance.choice([7.0, 20.0, 33.0])))
        case 3:
            run.tell(child_messages.SetBlackboard("", "nudge", chance.random()))


def run_on(run: ExactRun, ticks: int, chance: random.Random) -> None:
    """Runs up to a tick, at most a few ticks further, while it is disturbed."""
    while len(run.prints) < ticks * FINGERPRINT_BYTES:
        disturb(run, chance)
        run.run_ticks(4)
    run.pause()


def printed(run: ExactRun, after_s: float) -> list[tuple[float, str]]:
    return [
        (round(line.time, 6), line.text)
        for line in run.said_of(child_messages.Log)
        if line.time is not None and line.time > after_s and not line.of_world
    ]


def of_the_run(state: bytes) -> Any:
    """Returns a state of a world without what only tells whether somebody has looked at an IMU."""
    whole = msgspec.msgpack.decode(state)
    for robot in whole["robots"].values():
        for imu in robot["senses"]["imus"].values():
            imu.pop()
    return whole


def first_difference(these: bytes | bytearray, those: bytes | bytearray) -> int | None:
    """Returns the number of the first tick whose fingerprints differ."""
    size = FINGERPRINT_BYTES
    both = (each[at : at + size] for at in range(0, len(these), size) for each in (these, those))
    return next((at for at, (a, b) in enumerate(zip(both, both, strict=True)) if a != b), None)


def again(start: StartApplication, first: ExactRun, until_s: float | None) -> StartApplication:
    return structs.replace(start, replay=Replay(first.inputs, bytes(first.prints), until_s))


def same(run: ExactRun) -> Any:
    """Returns where the run is that was made again: it did not differ on its way."""
    assert [fault.message for fault in run.said_of(child_messages.Fault)] == []
    assert run.said_of(child_messages.Differs) == []
    (there,) = run.said_of(child_messages.WentBack)
    return there


def test_random_projects_do_the_same_again_from_any_moment() -> None:
    cases = [case(seed) for seed in range(count("exact_projects"))]
    holding = [project for project in cases if project.types & HOLDING_STATE]
    assert len(holding) >= 0.3 * len(cases)


def case(seed: int) -> RandomProject:
    chance = random.Random(seed)  # noqa: S311 - a test
    project = random_project(chance)
    with unpacked(project, seed) as start:
        with at_work(start) as first:
            for _ in range(chance.randrange(1, 5)):
                run_on(first, len(first.prints) // FINGERPRINT_BYTES + chance.randrange(3, 15), chance)
                enter(first, chance)
            run_on(first, len(first.prints) // FINGERPRINT_BYTES + chance.randrange(30, 60), chance)
            first.pause_after_tick()
            state = first.end()
        assert first.said_of(child_messages.Fault) == []
        ticks = len(first.prints) // FINGERPRINT_BYTES

        alone = ExactRun(again(start, first, None))
        assert same(alone).ticks == ticks
        assert of_the_run(alone.end()) == of_the_run(state)

        last = first.inputs[-1].step / 240 if first.inputs else 0.0
        latest_s = sorted(tick.t for tick in first.said_of(child_messages.Tick))[-TICKS_LEFT]
        with at_work(again(start, first, chance.uniform(last + 0.1, max(last + 0.2, latest_s)))) as back:
            there = same(back)
            assert there.inputs == len(first.inputs)
            run_on(back, ticks - there.ticks - 4, chance)
            back.end()
        rest = first.prints[there.ticks * FINGERPRINT_BYTES :]
        shared = min(len(rest), len(back.prints))
        assert shared >= FINGERPRINT_BYTES
        at = first_difference(back.prints[:shared], rest[:shared])
        assert at is None, f"tick {there.ticks + at} of seed {seed}, {project}"
        lines, before = printed(back, there.t), printed(first, there.t)
        until_s = min(max((t for t, _ in each), default=0.0) for each in (lines, before))
        assert [each for each in lines if each[0] <= until_s] == [
            each for each in before if each[0] <= until_s
        ]
    return project


def test_a_state_of_the_world_that_differs_in_one_thing_is_found() -> None:
    """The target of the motors, or where the noise is: a run from such a state does something else."""
    projects = (random_project(random.Random(seed)) for seed in itertools.count())  # noqa: S311 - a test
    project = next(each for each in projects if not each.types & {"Drive", "Late"})
    with unpacked(project, 1) as start:
        before = ExactRun(start, is_fresh=False)
        before.run_ticks(20)
        before.pause_after_tick()
        state = before.end()
        first, second = (from_state(start, state) for _ in range(2))
        assert first_difference(first, second) is None
        for changed in (with_another_target, with_another_noise):
            assert first_difference(first, from_state(start, changed(state))) is not None, changed.__name__


def from_state(start: StartApplication, state: bytes) -> bytes:
    """Returns the fingerprints of the first ticks of a run in a world with this state."""
    run = ExactRun(structs.replace(start, world_state=state), is_fresh=False)
    run.run_ticks(FEW)
    run.pause()
    run.end()
    return bytes(run.prints[: FEW * FINGERPRINT_BYTES])


def with_another_target(state: bytes) -> bytes:
    whole = msgspec.msgpack.decode(state)
    whole["robots"]["robot"]["drive"][0] = [0.3, 0.0]
    return msgspec.msgpack.encode(whole)


def with_another_noise(state: bytes) -> bytes:
    whole = msgspec.msgpack.decode(state)
    generator = whole["robots"]["robot"]["noise"]["state"]
    generator["state"] = hex(int(generator["state"], 16) + 2)
    return msgspec.msgpack.encode(whole)
