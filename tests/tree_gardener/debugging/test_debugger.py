from __future__ import annotations

from typing import Any

import pytest

from tests.tree_gardener.debugging.trees import User, calls, named, tree_of
from tree_gardener import ControlNode, Status
from tree_gardener.debugging import (
    Breakpoint,
    BreakpointError,
    DebuggingEnded,
    Force,
    ForceError,
    Position,
    Step,
    When,
    place_of,
)
from tree_gardener.debugging.debugger import Debugger

THREE = '<Sequence name="all"><Leaf name="a.S"/><Leaf name="b.S"/><Leaf name="c.S"/></Sequence>'


def at(tree: Any, *names: str, **how: Any) -> list[Breakpoint]:
    return [Breakpoint(place_of(named(tree, name)), **how) for name in names]


@pytest.mark.parametrize("warm", [0, 10])
def test_a_breakpoint_that_is_set_at_a_stop_takes_effect_in_the_same_tick(warm: int) -> None:
    tree = tree_of(THREE)
    user = User(tree)
    for _ in range(warm):  # with and without generated code
        tree.tick_exactly_once()
    user.debugger.set_breakpoints(at(tree, "a"))
    user.at_next(lambda debugger: debugger.set_breakpoints(at(tree, "b")))
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert user.take() == ["a: before its tick", "b: before its tick"]


def test_a_breakpoint_that_is_removed_at_a_stop_does_not_stop_the_tick_in_progress() -> None:
    tree = tree_of(THREE)
    user = User(tree)
    user.debugger.set_breakpoints(at(tree, "a", "c"))
    user.at_next(lambda debugger: debugger.turn_breakpoints(on=False))
    tree.tick_exactly_once()
    tree.tick_exactly_once()
    assert user.take() == ["a: before its tick"]
    user.debugger.turn_breakpoints(on=True)
    tree.tick_exactly_once()
    assert user.take() == ["a: before its tick", "c: before its tick"]


def test_steps_lead_into_over_and_out_of_nodes() -> None:
    tree = tree_of(
        '<Sequence name="all"><Inverter name="not"><Leaf name="a.F"/></Inverter>'
        '<Fallback name="try"><Leaf name="b.F"/><Leaf name="c.S"/></Fallback><Leaf name="d.S"/></Sequence>'
    )
    user = User(tree)
    user.debugger.set_breakpoints(at(tree, "not"))
    user.at_next(
        lambda debugger: debugger.resume(Step.OVER),
        lambda debugger: debugger.resume(Step.INTO),
        lambda debugger: debugger.resume(Step.INTO),
        lambda debugger: debugger.resume(Step.OUT),
        lambda debugger: debugger.resume(Step.TICK),
        lambda debugger: debugger.resume(Step.TO, named(tree, "d").uid),
        lambda debugger: debugger.resume(),
    )
    tree.tick_exactly_once()
    tree.tick_exactly_once()
    assert user.take() == [
        "not: before its tick",
        "not: it returned SUCCESS",
        "try: before its tick",
        "b: before its tick",
        "try: it returned SUCCESS",
        "all: before its tick",
        "not: before its tick",  # the breakpoint, on the way
    ]


def test_preconditions_that_decide_and_halts_are_stops() -> None:
    tree = tree_of(
        '<ReactiveSequence name="all"><Leaf name="a.S" _skipIf="true"/><Leaf name="b.S" _failureIf="false"/>'
        '<Leaf name="w.S" _while="false"/>'
        '<Inverter><Leaf name="f.S" _successIf="true"/></Inverter></ReactiveSequence>'
    )
    user = User(tree)
    user.debugger.request_hold()
    user.at_next(*[lambda debugger: debugger.resume(Step.INTO)] * 20)
    tree.tick_exactly_once()
    stops = user.take()
    assert [stop for stop in stops if "decided" in stop] == [
        "a: _skipIf decided SKIPPED",
        "w: _while decided SKIPPED",
        "f: _successIf decided SUCCESS",
    ]
    assert stops.index("a: before its tick") + 1 == stops.index("a: _skipIf decided SKIPPED")
    assert "b: it returned SUCCESS" in stops


def test_a_halt_within_a_tick_is_a_stop_and_one_after_the_run_is_none() -> None:
    tree = tree_of('<ReactiveSequence name="all"><Leaf name="a.SSF"/><Leaf name="b.R"/></ReactiveSequence>')
    user = User(tree)
    user.debugger.set_breakpoints(at(tree, "b", when=When.HALTED))
    for _ in range(3):
        tree.tick_exactly_once()
    assert user.take() == ["b: it was halted"]
    tree.tick_exactly_once()
    user.debugger.request_hold()
    tree.halt()
    assert user.take() == []


def test_a_stop_tells_what_led_there_and_what_may_come() -> None:
    tree = tree_of(
        '<Sequence name="all"><Leaf name="a.S"/><Fallback name="try"><Leaf name="b.F"/>'
        '<Leaf name="c.S"/></Fallback><Leaf name="d.S"/></Sequence>'
    )
    user = User(tree)
    user.debugger.set_breakpoints(at(tree, "b"))
    tree.tick_exactly_once()
    stop = user.last
    uid = {node.name.partition(".")[0]: node.uid for node in tree.nodes}
    assert stop.why == "breakpoint 1 before its tick"
    assert stop.lead == (uid["all"], uid["try"], uid["b"])
    assert stop.ahead == (uid["b"], uid["c"], uid["d"])
    assert (stop.tick, stop.path) == (1, "b.F")
    assert user.debugger.held is None


def test_a_debugger_is_not_held_before_it_is_attached() -> None:
    debugger = Debugger(print)
    assert (debugger.held, debugger.alone) == (None, 0)


def test_all_instances_of_a_shared_subtree_or_one() -> None:
    sub = '<BehaviorTree ID="Sub"><Leaf name="x.S"/></BehaviorTree>'
    tree = tree_of('<Sequence><SubTree ID="Sub" name="one"/><SubTree ID="Sub" name="two"/></Sequence>', sub)
    user = User(tree)
    second = tree.nodes[-1]
    assert second.path == "two/x.S"
    user.debugger.set_breakpoints([Breakpoint(place_of(second))])
    tree.tick_exactly_once()
    assert len(user.take()) == 2
    user.debugger.set_breakpoints([Breakpoint(place_of(second, one_instance=True))])
    tree.tick_exactly_once()
    assert len(user.take()) == 1
    assert user.last.path == "two/x.S"


def test_a_wrong_breakpoint_leaves_all_as_they_were() -> None:
    tree = tree_of(THREE)
    user = User(tree)
    user.debugger.set_breakpoints(at(tree, "a"))
    with pytest.raises(BreakpointError, match="may only read"):
        user.debugger.set_breakpoints([*at(tree, "b"), *at(tree, "c", condition="x := 1")])
    tree.tick_exactly_once()
    assert user.take() == ["a: before its tick"]


@pytest.mark.parametrize("result", [Status.SUCCESS, Status.FAILURE, Status.SKIPPED])
def test_a_running_node_is_halted_with_its_children_before_its_result_is_forced(result: Status) -> None:
    tree = tree_of(
        '<Fallback><Sequence name="s" _onHalted="h := 1"><Leaf name="a.R"/></Sequence>'
        '<Leaf name="b.S"/></Fallback>'
    )
    user = User(tree)
    results = tree.log_results()
    tree.tick_exactly_once()
    results.clear()
    user.debugger.force(Force(named(tree, "s").uid, result, once=True))
    tree.tick_exactly_once()
    assert calls(tree, "a") == ["initialise", "update", "terminate INVALID"]
    assert results[0] == (named(tree, "s").uid, result)
    assert tree.blackboard["h"] == 1
    assert user.debugger.forces == []
    tree.tick_exactly_once()
    assert calls(tree, "a")[3:] == ["initialise", "update"]


def test_a_result_is_forced_from_now_on_until_it_is_released() -> None:
    tree = tree_of('<Leaf name="a.S"/>')
    user = User(tree)
    force = Force(1, Status.FAILURE)
    user.debugger.force(force)
    assert [tree.tick_exactly_once() for _ in range(7)] == [Status.FAILURE] * 7
    assert user.debugger.forces == [force]
    assert calls(tree, "a") == []
    assert user.debugger.release(1)
    assert not user.debugger.release(1)
    assert tree.tick_exactly_once() is Status.SUCCESS


def test_a_result_can_be_replaced_after_the_tick_and_at_the_stop_after_it() -> None:
    tree = tree_of('<Sequence name="s"><Leaf name="a.S"/><Leaf name="b.S"/></Sequence>')
    user = User(tree)
    a = named(tree, "a").uid
    user.debugger.force(Force(a, Status.FAILURE, once=True, position=Position.AFTER))
    assert tree.tick_exactly_once() is Status.FAILURE
    assert calls(tree, "a") == ["initialise", "update", "terminate SUCCESS"]
    user.debugger.set_breakpoints(at(tree, "a", when=When.AFTER))
    user.at_next(
        lambda debugger: debugger.force(Force(a, Status.FAILURE, once=True, position=Position.AFTER))
    )
    assert tree.tick_exactly_once() is Status.FAILURE
    assert tree.tick_exactly_once() is Status.SUCCESS


def test_preconditions_win_and_postconditions_run_with_a_forced_result() -> None:
    tree = tree_of('<Leaf name="a.S" _skipIf="skip" _onFailure="failed := 1"/>')
    tree.blackboard["skip"] = False
    user = User(tree)
    user.debugger.force(Force(1, Status.FAILURE))
    assert tree.tick_exactly_once() is Status.FAILURE
    assert tree.blackboard["failed"] == 1
    tree.blackboard["skip"] = True
    assert tree.tick_exactly_once() is Status.SKIPPED


def test_a_frozen_leaf_that_has_not_begun_is_not_called_until_it_is_released() -> None:
    tree = tree_of('<ReactiveSequence><Leaf name="c.SSF"/><Leaf name="a.S"/></ReactiveSequence>')
    user = User(tree)
    a = named(tree, "a")
    user.debugger.force(Force(a.uid, Status.RUNNING))
    assert tree.tick_exactly_once() is Status.RUNNING
    assert a.status is Status.RUNNING
    tree.tick_exactly_once()
    assert tree.tick_exactly_once() is Status.FAILURE  # its parent halts it
    assert a.status is Status.IDLE
    named(tree, "c").behaviour.name = "c.S"
    assert tree.tick_exactly_once() is Status.RUNNING  # it stays frozen
    assert calls(tree, "a") == []
    user.debugger.release(a.uid)
    assert a.status is Status.IDLE
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert calls(tree, "a") == ["initialise", "update", "terminate SUCCESS"]


def test_a_frozen_leaf_that_runs_continues_when_it_is_released_and_is_halted_as_always() -> None:
    tree = tree_of('<Sequence><Leaf name="a.RRS"/></Sequence>')
    user = User(tree)
    a = named(tree, "a")
    tree.tick_exactly_once()
    user.debugger.force(Force(a.uid, Status.RUNNING))
    tree.tick_exactly_once()
    user.debugger.release(None)
    tree.tick_exactly_once()
    assert calls(tree, "a") == ["initialise", "update", "update"]
    user.debugger.force(Force(a.uid, Status.RUNNING))
    tree.tick_exactly_once()
    tree.halt()
    assert calls(tree, "a")[3:] == ["terminate INVALID"]
    tree.tick_exactly_once()
    user.debugger.release(a.uid)
    assert (a.status, calls(tree, "a")[4:]) == (Status.IDLE, [])


def test_skip_to_here_skips_the_siblings_that_are_not_ticked_yet_once() -> None:
    tree = tree_of(
        '<Sequence name="s"><Leaf name="a.S"/><Leaf name="b.F"/><Leaf name="c.F"/>'
        '<Leaf name="d.S"/></Sequence>'
    )
    user = User(tree)
    user.debugger.set_breakpoints(at(tree, "b"))
    user.at_next(lambda debugger: debugger.skip_to(named(tree, "d").uid))
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert (len(calls(tree, "a")), calls(tree, "b"), calls(tree, "c")) == (3, [], [])
    assert user.debugger.forces == []
    user.debugger.set_breakpoints(at(tree, "c"))
    named(tree, "b").behaviour.name = "b.S"
    refused: list[str] = []

    def back(debugger: Debugger) -> None:
        with pytest.raises(ForceError) as error:
            debugger.skip_to(named(tree, "a").uid)
        refused.append(str(error.value))

    user.at_next(back)
    tree.tick_exactly_once()
    assert refused == ["'s' is past this node: it has reached 'c.F'"]


def test_skip_to_here_halts_a_running_sibling_and_leaves_nothing_behind() -> None:
    tree = tree_of('<Fallback><Leaf name="a.R"/><Leaf name="b.R"/><Leaf name="c.S"/></Fallback>')
    user = User(tree)
    tree.tick_exactly_once()
    user.debugger.skip_to(named(tree, "c").uid)
    assert [force.uid for force in user.debugger.forces] == [2, 3]
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert calls(tree, "a")[-1] == "terminate INVALID"
    assert user.debugger.forces == []


@pytest.mark.parametrize("parent", ["Parallel", "IfThenElse", "TryCatch"])
def test_skip_to_here_is_refused_where_a_skip_is_not_passed_over(parent: str) -> None:
    tree = tree_of(f'<{parent}><Leaf name="a.S"/><Leaf name="b.S"/></{parent}>')
    user = User(tree)
    with pytest.raises(ForceError, match=f"{parent} does not pass over skipped children"):
        user.debugger.skip_to(3)
    with pytest.raises(ForceError, match="no siblings"):
        user.debugger.skip_to(1)


def test_a_subtree_runs_alone_with_its_own_scope_and_all_else_halted() -> None:
    sub = (
        '<BehaviorTree ID="Sub"><Sequence name="in"><Script code="seen := given"/>'
        '<Leaf name="x.RS"/></Sequence></BehaviorTree>'
    )
    tree = tree_of('<Parallel><Leaf name="a.R"/><SubTree ID="Sub" name="one" given="7"/></Parallel>', sub)
    user = User(tree)
    tree.tick_exactly_once()
    inside = named(tree, "in")
    user.debugger.run_alone(inside.uid)
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert calls(tree, "a") == ["initialise", "update", "terminate INVALID"]
    assert [node.status for node in tree.nodes] == [Status.IDLE] * len(tree.nodes)
    assert inside.board["seen"] == 7
    assert tree.tick_exactly_once() is Status.SUCCESS
    user.debugger.release(None)
    tree.tick_exactly_once()
    assert calls(tree, "a")[3:] == ["initialise", "update"]


@pytest.mark.parametrize("is_detached", [False, True])
def test_a_subtree_that_runs_alone_is_halted_when_it_is_released_or_the_debugger_goes_within_it(
    is_detached: bool,
) -> None:
    tree = tree_of('<Sequence><Leaf name="a.R"/><Sequence name="s"><Leaf name="b.R"/></Sequence></Sequence>')
    user = User(tree)
    user.debugger.run_alone(named(tree, "s").uid)
    tree.tick_exactly_once()
    assert calls(tree, "b") == ["initialise", "update"]
    user.debugger.set_breakpoints(at(tree, "b"))
    user.at_next(lambda debugger: tree.debug(None) if is_detached else debugger.release())
    tree.tick_exactly_once()
    tree.tick_exactly_once()
    assert calls(tree, "b")[-1] == "terminate INVALID"
    assert calls(tree, "a") == ["initialise", "update"]
    assert named(tree, "b").status is Status.IDLE


def test_the_root_runs_alone_as_it_is() -> None:
    with pytest.raises(ForceError, match="as it is"):
        User(tree_of(THREE)).debugger.run_alone(1)


class Swallowing(ControlNode):
    """Catches what it can of its children."""

    def update(self) -> Status:
        try:
            return self.tick_child(0)
        except Exception:  # noqa: BLE001, RUF100
            return Status.SUCCESS


def test_the_end_of_debugging_passes_through_users_code() -> None:
    tree = tree_of('<Swallowing name="s"><Leaf name="a.S"/></Swallowing>', Swallowing=Swallowing)
    user = User(tree)
    user.debugger.set_breakpoints(at(tree, "a"))

    def end(_debugger: Debugger) -> None:
        raise DebuggingEnded

    user.at_next(end)
    with pytest.raises(DebuggingEnded):
        tree.tick_exactly_once()
    assert user.debugger.held is None
    tree.shutdown()
    user.debugger.set_breakpoints([])
    assert tree.tick_exactly_once() is Status.SUCCESS  # the tree can be ticked again


def test_a_detached_debugger_is_not_asked_any_more() -> None:
    tree = tree_of(THREE)
    user = User(tree)
    user.debugger.set_breakpoints(at(tree, "a", "b"))
    user.at_next(lambda _debugger: tree.debug(None))
    tree.tick_exactly_once()
    tree.tick_exactly_once()
    assert user.take() == ["a: before its tick"]


@pytest.mark.parametrize("warm", [0, 10])
@pytest.mark.parametrize(
    ("force", "result"),
    [
        (Force(2, Status.FAILURE), Status.FAILURE),
        (Force(2, Status.FAILURE, once=True), Status.FAILURE),
        (Force(2, Status.RUNNING), Status.RUNNING),
        (Force(2, Status.SKIPPED, position=Position.AFTER), Status.SUCCESS),
    ],
)
def test_an_observer_learns_whose_result_was_forced(warm: int, force: Force, result: Status) -> None:
    tree = tree_of(THREE)
    debugger = Debugger(lambda _: None)
    tree.debug(debugger)
    seen: list[list[int]] = []
    tree.observe(lambda changes: seen.append(changes.forced))
    for _ in range(warm):
        tree.tick_exactly_once()
    debugger.force(force)
    assert tree.tick_exactly_once() is result
    debugger.release()
    tree.tick_exactly_once()
    assert seen[warm:] == [[2], []]
    assert not any(seen[:warm])
