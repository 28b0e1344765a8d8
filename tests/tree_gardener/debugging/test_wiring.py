from __future__ import annotations

import pytest

from tests.tree_gardener.debugging.trees import User, named, tree_of
from tree_gardener import Status, Tree
from tree_gardener.debugging import Breakpoint, Step, place_of
from tree_gardener.debugging.wiring import AskingGuard

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


def test_a_composite_that_holds_a_breakpoint_takes_the_general_way_and_others_do_not() -> None:
    tree = tree_of(TWO)
    user = User(tree)
    user.debugger.set_breakpoints([Breakpoint(place_of(named(tree, "a")), condition="false")])
    for _ in range(8):
        tree.tick_exactly_once()
    assert not is_generated(tree, "all")
    assert not is_generated(tree, "one")
    assert is_generated(tree, "two")
    user.debugger.set_breakpoints([])
    for _ in range(8):
        tree.tick_exactly_once()
    assert is_generated(tree, "all")


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
