"""Callbacks belong to the action that gave them: what their exceptions do."""

from __future__ import annotations

import asyncio
import inspect
from typing import Any

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import leaf, load
from tree_gardener import ControlNode, ManualClock, Status, TickError
from tree_gardener.callbacks import Owned, owned, owner
from tree_gardener.runner import Runner

given: list[Any] = []


class Helper:
    """Code of an action beside its class."""

    def give(self) -> None:
        given.append(owned(self.call))

    def call(self, what: str = "out of order") -> str:
        if what:
            raise ValueError(what)
        return "called"


def fail() -> None:
    Helper().call()


class Giving(py_trees.behaviour.Behaviour):
    """Gives a callback when it is set up, and runs without end."""

    def setup(self, **_: Any) -> None:
        Helper().give()

    def initialise(self) -> None:
        self.calls = ["initialise"]

    def update(self) -> PyTreesStatus:
        self.calls.append("update")
        return PyTreesStatus.RUNNING

    def terminate(self, new_status: PyTreesStatus) -> None:
        self.calls.append(f"terminate {new_status.name}")


@pytest.fixture(autouse=True)
def _nothing_is_given() -> None:
    given.clear()


def run(body: str = '<Giving name="a"/>', *, on_error: str, ticks: int = 1, **more: Any) -> Runner:
    tree = load(body, nodes={"Giving": Giving}, clock=ManualClock())
    tree.setup()
    runner = Runner(tree, tick_hz=10.0, on_error=on_error, **more)
    for _ in range(ticks):
        runner.tick_now()
    return runner


def test_nobody_owns_what_no_action_gives() -> None:
    def call() -> None: ...

    assert owner() is None
    assert owned(call) is call


def test_the_owner_is_found_through_helpers_and_callbacks() -> None:
    runner = run(on_error="stop")
    [callback] = given
    assert isinstance(callback, Owned)
    assert callback.owner is leaf(runner.tree, "a")
    later = Owned(Helper().give, callback.owner)
    later()
    assert given[1].owner is callback.owner


def test_a_callback_keeps_its_result_signature_and_equality() -> None:
    helper = Helper()
    callback = Owned(helper.call, None)
    assert callback("") == "called"
    assert callback == helper.call
    held: list[Any] = [callback]
    held.remove(helper.call)
    assert held == []
    assert inspect.signature(callback) == inspect.signature(helper.call)


def test_its_exception_makes_a_running_action_fail_at_the_next_tick() -> None:
    faults: list[TickError] = []
    runner = run('<Fallback><Giving name="a"/><Running/></Fallback>', on_error="failure", fault=faults.append)
    assert given[0]() is None
    assert leaf(runner.tree, "a").calls == ["initialise", "update"], "not before its tick"
    assert faults == []
    assert runner.tick_now() is Status.RUNNING
    assert leaf(runner.tree, "a").calls[-1] == "terminate FAILURE"
    [fault] = faults
    assert (fault.path, fault.message) == ("a", "ValueError: out of order")
    assert (fault.file, fault.line > 0) == (__file__, True)


@pytest.mark.parametrize("warm", [1, 10], ids=["by methods", "by generated code"])
def test_only_that_action_of_a_parallel_fails_and_begins_again_as_usual(warm: int) -> None:
    body = (
        '<ParallelAll max_failures="2"><KeepRunningUntilFailure><Inverter><Giving name="a"/></Inverter>'
        '</KeepRunningUntilFailure><Giving name="b"/></ParallelAll>'
    )
    runner = run(body, on_error="failure", ticks=warm)
    given[1]()
    runner.tick_now()
    a, b = leaf(runner.tree, "a"), leaf(runner.tree, "b")
    assert (a.calls[-1], b.calls[-1]) == ("update", "terminate FAILURE")
    assert a.calls.count("update") == warm + 1
    runner.tree.halt()
    runner.tick_now()
    assert b.calls == ["initialise", "update"]


def test_an_action_that_was_halted_meanwhile_does_not_fail_later() -> None:
    runner = run(on_error="failure")
    given[0]()
    runner.tree.halt()
    for _ in range(2):
        assert runner.tick_now() is Status.RUNNING


@pytest.mark.parametrize(("on_error", "ticks"), [("stop", 1), ("stop", 0), ("failure", 0)])
def test_otherwise_the_run_stops_even_if_somebody_catches_the_exception(on_error: str, ticks: int) -> None:
    runner = run(on_error=on_error, ticks=ticks)
    with pytest.raises(TickError, match=r"node 'a' \[Giving\]: ValueError: out of order at "):
        given[0]()
    runner.tick_now()
    assert runner.is_finished
    assert runner.error is not None
    assert runner.error.path == "a"
    assert leaf(runner.tree, "a").calls[-1] == "terminate INVALID"


def test_within_its_own_tick_the_action_gets_the_exception() -> None:
    class Spinning(Giving):
        def update(self) -> PyTreesStatus:
            given[0]()
            return PyTreesStatus.RUNNING

    tree = load("<Fallback><Spinning name='a'/><Running/></Fallback>", nodes={"Spinning": Spinning})
    tree.setup()
    runner = Runner(tree, tick_hz=10.0, on_error="failure")
    assert runner.tick_now() is Status.RUNNING
    assert leaf(tree, "a").calls == ["initialise", "terminate FAILURE"]


def test_what_the_caller_gets_where_the_action_will_fail() -> None:
    runner = run(on_error="failure")
    refuse = Owned(Helper().call, leaf(runner.tree, "a"), lambda error: f"refused: {error.message}")
    assert refuse() == "refused: ValueError: out of order"


def test_coroutine_functions_stay_coroutine_functions() -> None:
    class Awaiting(Giving):
        def setup(self, **_: Any) -> None:
            async def call(what: str) -> str:
                return Helper().call(what)

            given.append(owned(call))

    tree = load("<Awaiting name='a'/>", nodes={"Awaiting": Awaiting})
    tree.setup()
    runner = Runner(tree, tick_hz=10.0, on_error="failure")
    runner.tick_now()
    [callback] = given
    assert inspect.iscoroutinefunction(callback)
    assert asyncio.run(callback("")) == "called"
    assert asyncio.run(callback("no arm")) is None
    runner.tick_now()
    assert leaf(tree, "a").calls[-1] == "terminate FAILURE"


@pytest.mark.parametrize("on_error", ["stop", "failure"])
def test_a_timer_of_a_control_node_belongs_to_it(on_error: str) -> None:
    class Timed(ControlNode):
        def update(self) -> Status:
            self.start_timer(0.05, fail)
            return self.tick_child(0)

    clock = ManualClock()
    body = "<Fallback><Timed name='t'><Running/></Timed><Running/></Fallback>"
    tree = load(body, nodes={"Timed": Timed}, clock=clock)
    runner = Runner(tree, tick_hz=10.0, on_error=on_error)
    runner.tick_now()
    clock.sleep(0.1)
    runner.tick_now()
    assert runner.is_finished is (on_error == "stop")
    if on_error == "failure":
        assert [node.status.letter for node in tree.nodes] == ["R", "F", "I", "R"]


@pytest.mark.parametrize("error", [SystemExit(3), KeyError("arm")])
def test_sys_exit_counts_as_an_exception(error: BaseException) -> None:
    def leave() -> None:
        raise error

    runner = run(on_error="failure")
    Owned(leave, leaf(runner.tree, "a"))()
    assert runner.tick_now() is Status.FAILURE
