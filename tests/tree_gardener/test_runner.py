"""The runner: rate, commands at tick boundaries, overruns, ends."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import leaf, load, recording
from tree_gardener import Status, TickError
from tree_gardener.runner import Overrun, Runner, RunnerState

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

R, S, F = PyTreesStatus.RUNNING, PyTreesStatus.SUCCESS, PyTreesStatus.FAILURE


def runner(*results: Any, tick_hz: float = 10.0, **options: Any) -> Runner:
    return Runner(load('<A name="a"/>', nodes={"A": recording(*results)}), tick_hz=tick_hz, **options)


def drive(subject: Runner, until_s: float, step_s: float = 0.01, start_s: float = 0.0) -> list[float]:
    """Calls `tick_due` often; gives the times of the ticks."""
    ticks = []
    for step in range(round((until_s - start_s) / step_s)):
        now_s = round(start_s + step * step_s, 6)
        if subject.tick_due(now_s) is not None:
            ticks.append(now_s)
    return ticks


def test_it_ticks_at_its_rate() -> None:
    assert drive(runner(R), 0.45) == [0.0, 0.1, 0.2, 0.3, 0.4]


def test_late_calls_keep_to_the_grid_and_count_what_was_left_out() -> None:
    subject = runner(R)
    ticks = [now for now in (0.0, 0.1, 0.35, 0.39, 0.4, 0.5) if subject.tick_due(now) is not None]
    assert ticks == [0.0, 0.1, 0.35, 0.4, 0.5]
    assert subject.statistics.missed == 1


def test_time_that_goes_back_makes_a_tick_due() -> None:
    subject = runner(R)
    assert subject.tick_due(100.0) is Status.RUNNING
    assert subject.tick_due(0.0) is Status.RUNNING
    assert subject.tick_due(0.05) is None


def test_pause_step_and_resume() -> None:
    subject = runner(R)
    assert drive(subject, 0.15) == [0.0, 0.1]
    subject.pause()
    assert subject.state is RunnerState.PAUSED
    assert drive(subject, 1.0, start_s=0.2) == []
    subject.step(2)
    assert len(drive(subject, 1.2, start_s=1.0)) == 2
    subject.resume()
    assert drive(subject, 2.15, start_s=2.0) == [2.0, 2.1]


def test_the_rate_changes_at_the_next_tick() -> None:
    subject = runner(R)
    subject.tick_due(0.0)
    subject.set_tick_rate(20.0)
    assert drive(subject, 0.2, start_s=0.01) == [0.05, 0.1, 0.15]


@pytest.mark.parametrize("tick_hz", [0.0, -1.0, float("nan")])
def test_a_rate_must_be_positive(tick_hz: float) -> None:
    with pytest.raises(ValueError, match="more than 0"):
        runner(R, tick_hz=tick_hz)


@pytest.mark.parametrize("option", ["on_finish", "on_error"])
def test_unknown_options_are_refused(option: str) -> None:
    with pytest.raises(ValueError, match=option):
        runner(R, **{option: "explode"})  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("result", "status"), [(S, Status.SUCCESS), (F, Status.FAILURE), (Status.SKIPPED, Status.SKIPPED)]
)
def test_it_stops_at_the_end(result: Any, status: Status) -> None:
    ends: list[Status] = []
    subject = runner(R, result, finished=ends.append)
    assert len(drive(subject, 1.0)) == 2
    assert (ends, subject.status, subject.is_finished) == ([status], status, True)


def test_it_repeats_when_told() -> None:
    subject = runner(S, on_finish="repeat")
    assert len(drive(subject, 1.0)) == 10
    assert not subject.is_finished


def test_an_error_ends_the_run_and_halts_the_tree() -> None:
    faults: list[TickError] = []
    tree = load(
        '<Parallel failure_count="2"><A name="a"/><Raising name="b"/></Parallel>', nodes={"A": recording(R)}
    )
    subject = Runner(tree, tick_hz=10, fault=faults.append)
    assert subject.tick_due(0.0) is None
    assert subject.is_finished
    assert [fault.path for fault in faults] == ["b"]
    assert subject.error is faults[0]
    assert leaf(tree, "a").calls[-1] == "terminate INVALID from RUNNING"


def test_an_error_may_count_as_failure() -> None:
    faults: list[TickError] = []
    tree = load("<Fallback><Raising name='b'/><Running/></Fallback>")
    subject = Runner(tree, tick_hz=10, on_error="failure", fault=faults.append)
    assert drive(subject, 0.25) == [0.0, 0.1, 0.2]
    assert [fault.path for fault in faults] == ["b"]


def test_commands_given_inside_a_tick_wait_for_its_end() -> None:
    holder: list[Runner] = []

    class Stopper(py_trees.behaviour.Behaviour):
        def update(self) -> PyTreesStatus:
            holder[0].stop()
            assert holder[0].state is RunnerState.RUNNING
            return PyTreesStatus.RUNNING

    tree = load("<Stopper/>", nodes={"Stopper": Stopper})
    holder.append(Runner(tree, tick_hz=10))
    assert holder[0].tick_due(0.0) is Status.RUNNING
    assert holder[0].is_finished
    assert tree.nodes[0].status is Status.IDLE
    assert holder[0].tick_due(1.0) is None


def ticking(durations_s: list[float]) -> Callable[[], float]:
    """A measuring function for ticks that take as long as said."""

    def times() -> Iterator[float]:
        now_s = 0.0
        for duration_s in durations_s:
            yield now_s
            now_s += duration_s
            yield now_s

    iterator = times()
    return lambda: next(iterator)


def test_leaves_are_measured_only_with_a_callback_for_overruns() -> None:
    subject = runner(R)
    subject.tick_due(0.0)
    assert subject.tree.slowest == (0.0, 0)
    subject = runner(R, overrun=lambda overrun: None)
    subject.tick_due(0.0)
    assert subject.tree.slowest[1] == 1


def test_an_overrun_names_the_slow_node() -> None:
    overruns: list[Overrun] = []
    subject = runner(R, overrun=overruns.append, measure=ticking([0.02, 0.35, 0.02]))
    drive(subject, 0.25)
    assert [(found.tick, found.missed, found.slow_uid) for found in overruns] == [(2, 3, 1)]
    assert (subject.statistics.ticks, subject.statistics.overruns) == (3, 1)
    assert subject.statistics.longest_s == pytest.approx(0.35)


def test_shutdown_halts_and_shuts_down() -> None:
    subject = runner(R)
    subject.tick_due(0.0)
    subject.shutdown()
    assert leaf(subject.tree, "a").calls[-2:] == ["terminate INVALID from RUNNING", "shutdown"]


def test_the_tree_knows_which_action_is_being_ticked() -> None:
    seen: list[int] = []

    class Asking(py_trees.behaviour.Behaviour):
        def update(self) -> PyTreesStatus:
            seen.append(tree.current_uid)
            return PyTreesStatus.RUNNING

    tree = load("<Sequence><Succeeding/><Asking/></Sequence>", nodes={"Asking": Asking})
    Runner(tree, tick_hz=10).tick_due(0.0)
    assert seen == [3]
    assert tree.current_uid == 0


def test_a_caller_that_counts_the_ticks_decides_when_one_is_due() -> None:
    subject = runner(R, R, R, S, tick_hz=7.0)
    assert [subject.tick_now() for _ in range(2)] == [Status.RUNNING] * 2  # no time, so none is left out
    subject.pause()
    assert subject.tick_now() is None
    subject.step()
    assert [subject.tick_now(), subject.tick_now()] == [Status.RUNNING, None]
    subject.resume()
    assert subject.tick_now() is Status.SUCCESS
    assert subject.tick_now() is None
    assert subject.is_finished


@pytest.mark.parametrize("method", ["initialise", "update"])
def test_an_action_that_raises_in_its_first_tick_is_terminated_at_the_end_of_the_run(method: str) -> None:
    def fail(_: object) -> None:
        raise ValueError("no arm")

    cls = type("A", (recording(R),), {method: fail})
    halted: list[str] = []
    subject = Runner(
        load('<A name="a"/>', nodes={"A": cls}), tick_hz=10.0, halted=lambda: halted.append("halted")
    )
    subject.tick_now()
    assert leaf(subject.tree, "a").calls[-1] == "terminate INVALID from INVALID"
    assert (subject.is_finished, halted) == (True, ["halted"])


def test_an_error_outside_of_a_tick_ends_the_run_once_and_halts_the_tree() -> None:
    faults: list[str] = []
    ends: list[Status] = []
    subject = runner(R, fault=lambda error: faults.append(str(error)), finished=ends.append)
    subject.tick_now()
    for text in ("first", "second"):
        subject.fail(ValueError(text))
    assert leaf(subject.tree, "a").calls[-1] == "terminate INVALID from RUNNING"
    assert [fault.partition(" at ")[0] for fault in faults] == [
        f"a callback that belongs to no node: ValueError: {text}" for text in ("first", "second")
    ]
    assert (ends, str(subject.error)) == ([Status.FAILURE], faults[0])
