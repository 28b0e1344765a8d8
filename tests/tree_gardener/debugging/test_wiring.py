from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from tests.tree_gardener.debugging.trees import Leaf, User, named, tree_of
from tree_gardener import Status, Tree
from tree_gardener.debugging import Breakpoint, Debugger, Force, Position, Step, When, place_of
from tree_gardener.debugging.wiring import AskingGuard
from tree_gardener.ports import node_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from py_trees.common import Status as PyTreesStatus

    from tree_gardener.node import Node

TWO = (
    '<Sequence name="all"><Sequence name="one"><Leaf name="a.S"/><Leaf name="b.S"/></Sequence>'
    '<Sequence name="two"><Leaf name="c.S" _failureIf="false"/></Sequence></Sequence>'
)


def is_generated(tree: Tree, name: str) -> bool:
    node = named(tree, name)
    return f"# node {node.uid}" in tree.generated_source()


def test_without_breakpoints_nodes_are_ticked_as_without_a_debugger() -> None:
    plain, debugged = tree_of(TWO), tree_of(TWO)
    User(debugged)
    for tree in (plain, debugged):
        for _ in range(8):
            tree.tick_exactly_once()
    assert debugged.generated_source() == plain.generated_source() != ""
    assert [entry.__qualname__ for entry in debugged.nodes[0].ticks] == [
        entry.__qualname__ for entry in plain.nodes[0].ticks
    ]
    assert all(not isinstance(node.guard, AskingGuard) for node in debugged.nodes)


class Counting(Debugger):
    """A debugger that counts how often it is asked."""

    asked = 0

    def before(self, node: Node) -> None:
        self.asked += 1
        super().before(node)

    def after(self, node: Node, status: Status, decided: str) -> Status:
        self.asked += 1
        return super().after(node, status, decided)


def warm(tree: Tree, ticks: int = 8) -> None:
    for _ in range(ticks):
        tree.tick_exactly_once()
    assert is_generated(tree, "all")


@pytest.mark.parametrize(
    ("how", "asked"),
    [
        ({}, 1),
        ({"condition": "n == 1"}, 0),
        ({"condition": "n == 2"}, 1),
        ({"condition": "nothing == 2"}, 1),
        ({"when": When.RETURNS, "status": Status.FAILURE}, 0),
        ({"when": When.RETURNS, "status": Status.SUCCESS, "condition": "n == 1"}, 0),
        ({"when": When.AFTER, "condition": "nothing == 2"}, 1),
        ({"when": When.AFTER}, 1),
        ({"when": When.HALTED}, 0),
    ],
)
def test_generated_code_asks_only_where_a_breakpoint_can_stop(how: dict[str, Any], asked: int) -> None:
    tree = tree_of(TWO)
    tree.blackboard["n"] = 2
    debugger = Counting(lambda stop: None)
    tree.debug(debugger)
    places = [place_of(named(tree, name)) for name in ("a", "b", "two", "c")]
    debugger.set_breakpoints([Breakpoint(place, **{"hits": 1000, **how}) for place in places])
    if how.get("condition") == "nothing == 2":
        for _ in range(8):
            tree.tick_exactly_once()
        assert debugger.asked >= 8 * len(places)  # each stops, since it cannot be tested
        return
    warm(tree)
    debugger.asked = 0
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert debugger.asked == asked * len(places)


def test_nodes_with_breakpoints_are_in_generated_code_but_not_those_with_forced_results() -> None:
    tree = tree_of(TWO)
    user = User(tree)
    user.debugger.set_breakpoints([Breakpoint(place_of(named(tree, "a")), condition="false")])
    warm(tree)
    assert ".is_over" not in tree.generated_source()
    user.debugger.force(Force(named(tree, "two").uid, Status.FAILURE))
    warm(tree)
    assert "ticks0[1]" in tree.generated_source()
    assert ".is_over" in tree.generated_source()
    assert tree.tick_exactly_once() is Status.FAILURE


STOP_AT = "n == 8"


def stop_in_code(tree: Tree, *, at: str, **how: Any) -> User:
    """A user who is held in the ninth tick, the first ones of which have made generated code."""
    user = User(tree)
    user.debugger.set_breakpoints([Breakpoint(place_of(named(tree, at)), condition=STOP_AT, **how)])
    for number in range(8):
        tree.blackboard["n"] = number
        tree.tick_exactly_once()
    assert user.stops == []
    assert is_generated(tree, "all")
    tree.blackboard["n"] = 8
    return user


@pytest.mark.parametrize("other", ["b", "c", "two"])
def test_a_breakpoint_that_is_set_at_a_stop_in_generated_code_stops_in_the_same_tick(other: str) -> None:
    tree = tree_of(TWO)
    user = stop_in_code(tree, at="a")
    user.at_next(
        lambda debugger: debugger.set_breakpoints([Breakpoint(place_of(named(tree, other)), When.AFTER)])
    )
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert user.take() == ["a: before its tick", f"{other}: it returned SUCCESS"]


@pytest.mark.parametrize("other", ["b", "c", "two"])
def test_a_stop_below_a_node_that_generated_code_calls_reaches_the_nodes_after_it(other: str) -> None:
    tree = tree_of(TWO.replace('<Leaf name="a.S"/>', '<Repeat num_cycles="1"><Leaf name="a.S"/></Repeat>'))
    user = stop_in_code(tree, at="a")
    assert "ticks1[0]" in tree.generated_source()
    user.at_next(
        lambda debugger: debugger.set_breakpoints([Breakpoint(place_of(named(tree, other)), When.AFTER)])
    )
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert user.take() == ["a: before its tick", f"{other}: it returned SUCCESS"]


@pytest.mark.parametrize("when", [When.BEFORE, When.AFTER])
@pytest.mark.parametrize("is_observed", [False, True])
def test_steps_from_a_stop_in_generated_code_end_where_they_do_by_the_methods(
    when: When, *, is_observed: bool
) -> None:
    found = []
    for is_generated_ in (False, True):
        tree = tree_of(TWO)
        counts = tree.count_results()
        reports: list[Any] = []
        if is_observed:
            tree.observe(lambda changes, seen=reports: seen.append((changes.changed, changes.flashed)))  # type: ignore[misc]
        tree.generate_code(on=is_generated_)
        user = stop_in_code(tree, at="b", when=when) if is_generated_ else User(tree)
        if not is_generated_:
            for _ in range(8):
                tree.tick_exactly_once()
            user.debugger.set_breakpoints([Breakpoint(place_of(named(tree, "b")), when)])
        states: list[str] = []
        look = [lambda debugger: states.append("".join(node.status.letter for node in tree.nodes))] * 20  # noqa: B023
        steps = [Step.INTO, Step.OVER, Step.OUT, Step.INTO, Step.CONTINUE]
        user.at_next(*[_both(see, step) for see, step in zip(look, steps, strict=False)])
        tree.tick_exactly_once()
        found.append((user.take(), states, [count.ticks for count in counts], reports))
    assert found[0] == found[1]
    assert len(found[0][0]) >= 3


def _both(see: Callable[[Debugger], None], step: Step) -> Callable[[Debugger], None]:
    def act(debugger: Debugger) -> None:
        see(debugger)
        debugger.resume(step)

    return act


def test_a_stop_in_one_slice_of_many_children_reaches_the_next_slices() -> None:
    leaves = "".join(f'<Leaf name="l{number}.S"/>' for number in range(50))
    for control in ("Sequence", "ReactiveSequence"):
        tree = tree_of(f'<{control} name="all">{leaves}</{control}>')
        user = stop_in_code(tree, at="l3")
        user.at_next(lambda debugger: debugger.resume(Step.TO, named(tree, "l45").uid))  # noqa: B023
        assert tree.tick_exactly_once() is Status.SUCCESS
        assert user.take() == ["l3: before its tick", "l45: before its tick"]


def test_a_stop_below_a_parallel_reaches_its_other_children() -> None:
    leaves = "".join(f'<Leaf name="l{number}.R"/>' for number in range(50))
    tree = tree_of(f'<ParallelAll name="all">{leaves}</ParallelAll>')
    user = stop_in_code(tree, at="l3", when=When.RETURNS, status=Status.RUNNING)
    user.at_next(
        lambda debugger: debugger.resume(Step.INTO),
        lambda debugger: debugger.resume(Step.TO, named(tree, "l45").uid),
    )
    assert tree.tick_exactly_once() is Status.RUNNING
    assert user.take() == ["l3: it returned RUNNING", "l4: before its tick", "l45: before its tick"]
    assert {named(tree, f"l{number}").behaviour.calls.count("update") for number in range(50)} == {9}


class Halting(Leaf):
    """Halts the tree in the ninth call of the method that its name says."""

    def initialise(self) -> None:
        super().initialise()
        self.halt_in("initialise")

    def update(self) -> Any:
        status = super().update()
        self.halt_in("update")
        return status

    def terminate(self, new_status: PyTreesStatus) -> None:
        super().terminate(new_status)
        self.halt_in("terminate SUCCESS")

    def halt_in(self, call: str) -> None:
        if self.calls[-1] == call and call.startswith(self.name[:6]) and self.calls.count(call) == 9:
            node_of(self).tree.halt()


@pytest.mark.parametrize("name", ["initialise.S", "update.S", "terminate.S", "update.R"])
@pytest.mark.parametrize("is_generated_", [False, True])
def test_a_step_from_a_halt_within_an_action_ends_at_the_result_of_this_action(
    name: str, *, is_generated_: bool
) -> None:
    control = "ReactiveSequence"
    acting = f'<Inverter><Inverter><Halting name="{name}"/></Inverter></Inverter>'
    if name == "update.R":
        control, acting = "ParallelAll", '<Halting name="update.R"/>'
    tree = tree_of(f'<{control} name="all">{acting}<Leaf name="w.R"/></{control}>', Halting=Halting)
    tree.generate_code(on=is_generated_)
    tree.observe(lambda changes: None)
    user = User(tree)
    user.debugger.set_breakpoints([Breakpoint(place_of(named(tree, "w")), When.HALTED)])
    for _ in range(8):
        tree.tick_exactly_once()
    assert user.take() == []
    assert is_generated(tree, "all") is (is_generated_ and control != "ParallelAll")
    user.at_next(lambda debugger: debugger.resume(Step.INTO))
    tree.tick_exactly_once()
    result = {"S": "SUCCESS", "R": "RUNNING"}[name[-1]]
    assert user.take() == ["w: it was halted", f"{name[:-2]}: it returned {result}"]


def test_what_a_precondition_decides_in_generated_code_is_such_a_stop() -> None:
    tree = tree_of('<Sequence name="all"><Leaf name="a.S"/><Leaf name="b.S" _skipIf="n == 8"/></Sequence>')
    user = stop_in_code(tree, at="b", when=When.AFTER)
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert user.take() == ["b: _skipIf decided SKIPPED"]


def test_a_result_that_is_forced_at_a_stop_in_generated_code_holds_in_this_tick() -> None:
    for when, force in ((When.BEFORE, Position.BEFORE), (When.AFTER, Position.AFTER)):
        tree = tree_of(TWO)
        user = stop_in_code(tree, at="a", when=when)
        user.at_next(
            lambda debugger: debugger.force(Force(named(tree, "a").uid, Status.FAILURE, True, force))  # noqa: B023
        )
        assert tree.tick_exactly_once() is Status.FAILURE
        assert tree.tick_exactly_once() is Status.SUCCESS


def test_an_observer_hears_of_all_that_runs_at_a_stop_in_generated_code() -> None:
    tree = tree_of(TWO)
    tree.observe(lambda changes: None)
    user = stop_in_code(tree, at="b")
    seen: list[tuple[int, Status]] = []
    user.at_next(lambda debugger: seen.extend(tree._recorder.collect(0.0).changed))
    tree.tick_exactly_once()
    running = [named(tree, name).uid for name in ("all", "one")]
    assert [(uid, Status.RUNNING) for uid in running] == sorted(pair for pair in seen if pair[0] in running)


def test_many_breakpoints_link_once(monkeypatch: pytest.MonkeyPatch) -> None:
    tree = tree_of(TWO)
    user = User(tree)
    links: list[int] = []
    rewire = tree.rewire
    monkeypatch.setattr(tree, "rewire", lambda: (links.append(1), rewire()))
    user.debugger.set_breakpoints([Breakpoint(place_of(node)) for node in tree.nodes])
    assert len(links) == 1
    user.debugger.set_breakpoints([Breakpoint(place_of(node)) for node in tree.nodes])
    assert len(links) == 1


def test_nodes_have_their_own_guards_again_and_the_one_at_the_stop_still_ends_its_tick() -> None:
    tree = tree_of('<Sequence><Leaf name="a.S"/><Leaf name="b.S" _post="after := 1"/></Sequence>')
    guards = [node.guard for node in tree.nodes]
    user = User(tree)
    user.debugger.set_breakpoints([Breakpoint(place_of(node)) for node in tree.nodes])
    user.at_next(*[lambda debugger: debugger.set_breakpoints([])])
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert tree.blackboard["after"] == 1
    assert len(user.take()) == 1
    assert [node.guard for node in tree.nodes] == guards


def test_hooks_counts_and_logs_see_what_is_forced_or_ticked_once() -> None:
    tree = tree_of(TWO)
    counts, log = tree.count_results(), tree.log_results()
    before: list[str] = []
    tree.add_hook(before=lambda node: before.append(node.name), node=named(tree, "a"))
    user = User(tree)
    user.debugger.request_hold()
    user.at_next(*[lambda debugger: debugger.resume(Step.INTO)] * 30)
    tree.tick_exactly_once()
    assert before == ["a.S"]
    assert [count.ticks for count in counts] == [1] * len(tree.nodes)
    assert sorted(uid for uid, _ in log) == [node.uid for node in tree.nodes]


@pytest.mark.parametrize("levels", [60, 149, 700])
def test_deep_trees_can_be_stopped_everywhere(levels: int) -> None:
    subs = "".join(
        f'<BehaviorTree ID="T{level}"><SubTree ID="T{level + 1}"/></BehaviorTree>'
        for level in range(1, levels)
    )
    subs += f'<BehaviorTree ID="T{levels}"><Leaf name="a.S"/></BehaviorTree>'
    tree = tree_of('<SubTree ID="T1"/>', subs)
    tree.count_results()
    user = User(tree)
    user.debugger.request_hold()
    user.at_next(*[lambda debugger: debugger.resume(Step.INTO)] * (2 * levels + 10))
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert len(user.take()) == 2 * len(tree.nodes)
