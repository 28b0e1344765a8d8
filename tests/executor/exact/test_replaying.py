"""A run is made again: its inputs enter at the same places, and what differs is found."""

from __future__ import annotations

import random
from hashlib import blake2b
from typing import TYPE_CHECKING, Any

import msgspec
import pytest

from executor import child_messages
from executor.child_messages import ForWorld, decode_to_exact
from executor.exact.loop import ExactLoop
from executor.exact.replaying import NotThereError, Replaying
from executor.headless.stepper import Stepper
from executor.replay_messages import Input, Replay
from tests.budget import count
from tests.fakes.stepped_world import SteppedNode, SteppedWorld, stepped_sensors

if TYPE_CHECKING:
    from collections.abc import Callable


class Run:
    """A loop with a world that only counts, and an account of all that happens in it."""

    def __init__(self) -> None:
        self.world = SteppedWorld()
        node: Any = SteppedNode(self.world)
        world: Any = self.world
        self.loop = ExactLoop(
            world,
            stepped_sensors(),
            node,
            lambda message: None,
            stepper=Stepper(world, stepped_sensors(), node),
            tick=self._tick,
            is_ticking=lambda: True,
            tick_hz=20.0,
            sleep=lambda duration_s: None,
        )
        self.done: list[Any] = []
        self.inputs: list[Input] = []
        self.prints = bytearray()
        self.hold: Callable[[], None] = lambda: None

    def _tick(self) -> None:
        self.done.append(("tick", self.world.steps))
        self.hold()
        self.prints += self.fingerprint()

    def fingerprint(self) -> bytes:
        return blake2b(repr(self.done).encode(), digest_size=8).digest()

    def obey(self, message: Any) -> None:
        command = message.command if isinstance(message, ForWorld) else message
        self.done.append((type(command).__name__, self.world.steps))
        if isinstance(command, child_messages.SetTickRate):
            self.loop.set_tick_rate(command.tick_hz)
        elif isinstance(command, child_messages.Reset):
            self.loop.reset()

    def enter(self, message: Any, hook: int = -1) -> None:
        place = (self.loop.ticks, self.loop.step_number, hook)
        self.inputs.append(Input(*place, msgspec.msgpack.encode(message)))
        self.obey(message)


def messages_of(chance: random.Random) -> Any:
    return chance.choice(
        [
            child_messages.SetBlackboard("", "k", 1),
            ForWorld(child_messages.Teleop(0.1, 0.2)),
            child_messages.SetTickRate(tick_hz=chance.choice([7.0, 20.0, 50.0])),
            ForWorld(child_messages.Reset()),
        ]
    )


def played(seed: int) -> Run:
    """Returns a run into which things entered at random moments of real time."""
    chance, run, now_s = random.Random(seed), Run(), 100.0  # noqa: S311 - a test
    run.loop.resume()
    for _ in range(120):
        now_s += chance.uniform(0.0, 0.06)
        run.loop.run_due(now_s)
        if chance.random() < 0.15:
            run.enter(messages_of(chance))
        if chance.random() < 0.1:
            run.loop.set_speed(chance.choice([0.3, 1.0, 4.0]))
    return run


def again(run: Run, until_s: float | None = None, resets: int = 0, **more: Any) -> tuple[Run, list[Any], Any]:
    copy, sent = Run(), list[Any]()
    fields = {"inputs": run.inputs, "fingerprints": bytes(run.prints)} | more
    replay = Replay(until_s=until_s, resets=resets, **fields)
    replaying = Replaying(
        replay,
        copy.loop,
        obey=copy.obey,
        send=sent.append,
        fingerprint=copy.fingerprint,
        clock=lambda: 0.0,
    )
    return copy, sent, replaying.run()


def test_a_run_with_random_inputs_is_made_again_to_its_end() -> None:
    for seed in range(count("replayed_loops")):
        run = played(seed)
        copy, sent, reached = again(run)
        assert copy.done == run.done
        assert sent == []
        assert (reached.ticks, reached.inputs) == (run.loop.ticks, len(run.inputs))
        assert (reached.tick_hz, reached.resets) == (
            run.loop.tick_hz,
            sum(what == "Reset" for what, _ in run.done),
        )


def test_a_lost_input_is_found() -> None:
    found = 0
    for seed in range(count("replayed_loops")):
        run = played(seed)
        at = random.Random(seed).randrange(len(run.inputs))  # noqa: S311 - a test
        rest = run.inputs[:at] + run.inputs[at + 1 :]
        try:
            copy, sent, _ = again(run, inputs=rest)
        except NotThereError:
            found += 1
            continue
        assert copy.done != run.done
        found += any(isinstance(message, child_messages.Differs) for message in sent)
        assert sent or run.inputs[at].tick == run.loop.ticks  # after the last tick
    assert found > 0


def test_it_stops_after_the_first_tick_that_is_not_earlier() -> None:
    straight = Run()
    for _ in range(50):
        straight.loop.tick()
    for until_s, ticks in ((0.0, 1), (0.5, 11), (0.51, 12), (2.4, 49), (99.0, 50)):
        copy, _, reached = again(straight, until_s)
        assert (reached.ticks, copy.loop.ticks) == (ticks, ticks)
        assert reached.t == copy.world.time_s


def test_after_a_reset_it_is_the_later_moment() -> None:
    run = Run()
    for number in range(30):
        run.loop.tick()
        if number == 14:
            run.enter(ForWorld(child_messages.Reset()))
    _, _, first = again(run, 0.5, 0)
    _, _, second = again(run, 0.5, 1)
    assert (first.ticks, first.resets, first.inputs) == (11, 0, 0)
    assert (second.ticks, second.resets, second.inputs) == (26, 1, 1)


def test_the_tick_that_ended_the_run_is_not_made_again() -> None:
    run = Run()
    for _ in range(10):
        run.loop.tick()
    _, _, reached = again(run, None, fingerprints=bytes(run.prints[: 7 * 8]))
    assert reached.ticks == 7
    assert again(run, None, fingerprints=b"")[2].ticks == 0


def test_what_is_not_repeatable_is_said_once_with_its_tick() -> None:
    run = Run()
    for _ in range(10):
        run.loop.tick()
    wrong = bytearray(run.prints)
    wrong[3 * 8] ^= 1
    wrong[6 * 8] ^= 1
    _, sent, reached = again(run, fingerprints=bytes(wrong))
    (differs,) = sent
    assert (differs.tick, reached.ticks) == (4, 10)
    assert "seed" in differs.cause


def test_what_entered_at_a_stop_of_the_debugger_enters_there_again() -> None:
    run = Run()
    run.hold = lambda: run.enter(child_messages.Continue(), 0) if run.loop.ticks == 3 else None
    for _ in range(6):
        run.loop.tick()
    copy = Run()
    replay = Replay(run.inputs, bytes(run.prints), None)
    replaying = Replaying(replay, copy.loop, obey=copy.obey, send=print, fingerprint=copy.fingerprint)
    copy.hold = lambda: replaying.held(0) if copy.loop.ticks == 3 else None
    assert replaying.run().ticks == 6
    assert copy.done == run.done
    other = Run()
    lost = Replaying(replay, other.loop, obey=other.obey, send=print, fingerprint=other.fingerprint)
    other.hold = lambda: lost.held(1) if other.loop.ticks == 3 else None
    with pytest.raises(NotThereError, match="tick 3"):
        lost.run()


def test_it_tells_how_far_it_is() -> None:
    run, sent, now_s = Run(), list[Any](), iter(range(100))
    for _ in range(10):
        run.loop.tick()
    copy = Run()
    replay = Replay(run.inputs, bytes(run.prints), None)
    clock = lambda: float(next(now_s))  # noqa: E731 - a clock
    Replaying(
        replay, copy.loop, obey=copy.obey, send=sent.append, fingerprint=copy.fingerprint, clock=clock
    ).run()
    assert [message.fraction for message in sent] == [number / 10 for number in range(1, 11)]


def test_inputs_are_whole_messages() -> None:
    run = Run()
    run.enter(ForWorld(child_messages.Teleop(0.25, -1.0)))
    (kept,) = run.inputs
    assert decode_to_exact(kept.message) == ForWorld(child_messages.Teleop(0.25, -1.0))
