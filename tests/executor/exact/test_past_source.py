"""The source of a past tick with real processes: the lines that it ran, and the values that it had."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from executor import child_messages
from executor.child_messages import Stepped, StepTick, TickSource
from executor.replay_messages import FINGERPRINT_BYTES, Replay
from tests.executor.exact.exact_runs import ExactRun, app_folder, hashing_forward, start_message
from tests.executor.exact.test_going_back import bump_and_go
from tests.executor.exact.test_process import exact, ready
from tests.executor.session_client import SessionClient
from tests.executor.warm import warm_session

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from executor.source_events import SourceCall

pytestmark = pytest.mark.simulation

MARK = """        marker = f"{self.number} {self.digest.hexdigest()}"
        if self.number == 27:
            raise ValueError("too far")
"""
# A run may be far ahead before it hears that it is to pause.
NEVER_FAR = MARK.replace("27", "1_000_000")
STEPS = 6


class Past:
    """A run of a few seconds; what it wrote in its last ticks, with the times of these."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.written: list[tuple[float, str]] = []
        run = ExactRun(start_message(folder))
        run.run_ticks(8)
        run.tell(child_messages.ForWorld(child_messages.Teleop(0.1, 0.4)))
        run.run_ticks(4)
        run.pause()
        for _ in range(STEPS):
            run.tell(StepTick())
            run.until(lambda m: isinstance(m, Stepped))
            entries = run.said_of(child_messages.Blackboard)[-1].entries
            (text,) = [each.value for each in entries if each.key == "hash"]
            self.written.append((run.said_of(child_messages.Tick)[-1].t, text))
        run.end()
        self.inputs, self.prints = run.inputs, bytes(run.prints)

    def source(self, t_s: float, prints: bytes | None = None) -> tuple[TickSource, ExactRun]:
        """Makes the run again up to a tick; returns what is said of it."""
        replay = Replay(self.inputs, self.prints if prints is None else prints, t_s, shows_source=True)
        run = ExactRun(start_message(self.folder, replay=replay))
        assert run.process.wait(30) == 0  # it has nothing more to do
        run.kill()
        (source,) = run.said_of(TickSource)
        return source, run


@pytest.fixture(scope="module")
def past() -> Iterator[Past]:
    with app_folder(NEVER_FAR) as folder:
        yield Past(folder)


def update_of(source: TickSource, kind: str = "Forward") -> SourceCall:
    (call,) = [each for each in source.calls if each.function == f"{kind}.update"]
    return call


def named(found: list[Any]) -> dict[str, str]:
    return {value.name: value.text for value in found}


def test_a_tick_has_the_values_that_it_wrote_the_first_time(past: Past) -> None:
    for t_s, text in (past.written[0], past.written[3]):
        source, run = past.source(t_s)
        assert source.t == pytest.approx(t_s)
        call = update_of(source)
        assert named(call.locals)["marker"] == repr(text)
        assert named(call.fields)["self.number"] == text.split()[0]
        assert call.path.endswith("Forward::6")
        assert call.part == "tick"
        assert run.said_of(child_messages.Differs) == []
        text_of_file = source.files["actions/Forward.py"].splitlines()
        assert "\n".join(text_of_file) == hashing_forward(NEVER_FAR).rstrip("\n")
        ran = {text_of_file[line.line - 1].strip() for line in call.lines if line.times}
        assert 'set_output(self, "hash", f"{self.number} {self.digest.hexdigest()}")' in ran
        assert 'raise ValueError("too far")' not in ran


def test_the_tick_that_ended_the_run_is_shown_to_the_line_that_raised() -> None:
    with app_folder(MARK) as folder:
        run = ExactRun(start_message(folder))
        run.resume()
        run.until(lambda m: isinstance(m, child_messages.Finished))
        run.kill()
        past = Past.__new__(Past)
        past.folder, past.inputs, past.prints = folder, run.inputs, bytes(run.prints)
        last_s = max(tick.t for tick in run.said_of(child_messages.Tick))
        ticks = len(past.prints) // FINGERPRINT_BYTES
        source, again = past.source(last_s)
        call = update_of(source)
        assert (call.end, call.result) == ("raised", "ValueError: too far")
        assert max(line.line for line in call.lines if line.times) == max(
            number
            for number, line in enumerate(source.files[call.file].splitlines(), 1)
            if line.strip() == 'raise ValueError("too far")'
        )
        assert source.tick >= ticks
        assert again.said_of(child_messages.Fault) == []


def test_a_run_that_differs_says_from_which_tick_on(past: Past) -> None:
    wrong = past.prints[: 5 * FINGERPRINT_BYTES] + b"otherone" + past.prints[6 * FINGERPRINT_BYTES :]
    _, run = past.source(past.written[0][0], wrong)
    assert [each.tick for each in run.said_of(child_messages.Differs)] == [6]


HELPER = """class Scale:
    def __init__(self):
        self.calls = 0

    def of(self, number):
        self.calls += 1
        doubled = 2 * number
        return doubled
"""
HELPED = """        from lib.scale import Scale
        self.scale = getattr(self, "scale", None) or Scale()
        self.scale.of(self.number)
"""


def test_a_module_that_an_action_imports_is_shown_too() -> None:
    with app_folder(HELPED) as folder:
        (folder / "lib").mkdir()
        (folder / "lib/__init__.py").touch()
        (folder / "lib/scale.py").write_text(HELPER)
        past = Past(folder)
        source, run = past.source(past.written[2][0])
        (call,) = [each for each in source.calls if each.function == "Scale.of"]
        number = past.written[2][1].split()[0]
        assert (call.file, call.result) == ("lib/scale.py", str(2 * int(number)))
        assert named(call.locals) == {"doubled": str(2 * int(number)), "number": number}
        assert named(call.fields) == {"self.calls": number}
        assert call.path.endswith("Forward::6"), "it belongs to the block whose action called it"
        assert source.files["lib/scale.py"] == HELPER
        assert "actions/Forward.py" in source.files
        assert run.said_of(child_messages.Differs) == []


async def test_a_session_shows_the_source_of_a_tick_and_continues() -> None:
    async with warm_session() as (manager, client):
        at = await ready(client, exact(bump_and_go("1.0")))
        await client.event("tick", lambda d: d["n"] > 60, after=at)
        ticks = [each for each in client.events if each["command"] == "tick"]
        t_s = next(each["t"] for each in ticks if each["data"]["n"] > 30)
        order = {"job": "a1", "t": t_s}
        for bad in ({"job": "-"}, {"t": -1.0}, {"t": None}, {"more": 1}):
            assert (await client.ask("source_of_tick", {**order, **bad}))["code"] == "bad_data"
        refused = await client.ask("source_of_tick", {**order, "run": "ffffffffffff"})
        assert refused["code"] == "unknown_run"
        viewer = await SessionClient(manager.ready["port"]).open()
        assert (await viewer.ask("source_of_tick", order))["code"] == "not_driver"
        await viewer.close()

        assert await client.ask("source_of_tick", order) == "ack"
        found = (await client.event("tick_source"))["data"]
        assert (found["job"], found["problem"], found["differs"]) == ("a1", "", None)
        assert found["t"] == pytest.approx(t_s, abs=0.06)
        assert {each["function"] for each in found["calls"]} >= {"Forward.update"}
        assert client.named("branch") == []
        assert client.state == "application_running"
        number = max(each["n"] for each in client.named("tick"))
        await client.event("tick", lambda d: d["n"] > number + 5)

        at = len(client.events)
        assert await client.ask("source_of_tick", {"job": "b2", "t": 1e6}) == "ack"
        ended = (await client.event("tick_source", after=at))["data"]
        assert "no tick at this moment" in ended["problem"]
        at = len(client.events)
        assert await client.ask("source_of_tick", {**order, "job": "c3"}) == "ack"
        assert await client.ask("stop_source", {"job": "c3"}) == "ack"
        assert "stopped" in (await client.event("tick_source", after=at))["data"]["problem"]
        assert await client.ask("disconnect") == "ack"
