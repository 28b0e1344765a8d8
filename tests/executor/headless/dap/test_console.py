"""The commands of the console, on a tree that is held before its first tick."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.headless.dap.console import Console
from tests.tree_gardener.debugging.trees import calls, tree_of
from tree_gardener import Status, Tree
from tree_gardener.debugging import Debugger, Step

if TYPE_CHECKING:
    from tree_gardener.debugging import Stop

SUB = '<BehaviorTree ID="Sub"><Leaf name="x.S"/></BehaviorTree>'
BODY = (
    '<Sequence name="all"><Leaf name="a.S"/>'
    '<Fallback name="try"><Leaf name="b.F"/><Leaf name="c.S"/></Fallback></Sequence>'
)
SHARED = '<Sequence name="all"><SubTree ID="Sub" name="one"/><SubTree ID="Sub" name="two"/></Sequence>'


def answers(*lines: str, tree: Tree | None = None, ticks: int = 1, to: int = 1) -> tuple[Tree, list[str]]:
    """Ticks a tree that is held before the tick of a node, and gives the lines there; returns the answers."""
    tree = tree or tree_of(BODY)
    said: list[str] = []

    def hold(stop: Stop) -> None:
        if stop.uid != to:
            debugger.resume(Step.TO, to)
            return
        said.extend(console.answer(line) for line in lines)
        debugger.resume(Step.CONTINUE)

    debugger = Debugger(hold)
    console = Console(tree, debugger)
    tree.debug(debugger)
    debugger.request_hold()
    for _ in range(ticks):
        tree.tick_exactly_once()
    return tree, said


def test_the_path_the_nodes_ahead_and_the_tree_are_printed() -> None:
    _, [where, ahead, tree] = answers("where", "ahead", "tree", to=4)
    assert where.splitlines() == [
        "#1 all [Sequence] RUNNING",
        "  #3 try [Fallback] RUNNING",
        "    #4 b.F [Leaf] IDLE",
        "before its tick: step to this node",
    ]
    assert ahead.splitlines() == ["#4 b.F", "#5 c.S"]
    assert [line for line in tree.splitlines() if line.startswith("->")] == ["->     #4 b.F [Leaf] IDLE"]
    assert len(tree.splitlines()) == 5


def test_results_are_forced_frozen_skipped_and_released() -> None:
    tree, said = answers("force a.S failure once", "force b.F success after", "forces", "release all")
    assert said == [
        "#2 a.S is FAILURE once",
        (both := "#2 a.S is FAILURE once\n#4 b.F is SUCCESS after its tick"),
        both,
        "nothing is forced",
    ]
    tree, said = answers("freeze a.S")
    assert (said, tree.nodes[1].status) == (["#2 a.S is frozen"], Status.RUNNING)
    tree, _ = answers("skip c.S", to=3)
    assert calls(tree, "b") == []
    tree, said = answers("alone try", ticks=2)
    assert said == ["#3 try runs alone"]
    assert len(calls(tree, "a")) == 3
    assert answers("release a.S")[1] == ["nothing was forced there\nnothing is forced"]


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("force a.S", "write: force NODE"),
        ("force a.S running", "freeze NODE"),
        ("force 'a", "No closing quotation"),
        ("force z failure", "no node has the path, name or type 'z'; `tree` lists all nodes"),
        ("freeze Leaf", "3 nodes are called 'Leaf': #2 a.S, #4 b.F, #5 c.S; name one by its number or path"),
        ("freeze #99", "no node has the path, name or type '#99'"),
        ("skip a b", "name one node"),
        ("skip all", "the root has no siblings"),
        ("alone all", "the root runs alone as it is"),
        ("help fly", "'fly' is no command"),
    ],
)
def test_a_wrong_line_is_answered_in_one_sentence(line: str, why: str) -> None:
    _, [said] = answers(line)
    assert why in said
    assert len(said.splitlines()) == 1


@pytest.mark.parametrize(
    ("name", "uid"), [("#4", 4), ("4", 4), ("two/x.S", 5), ("one", 2), ("Sequence", 1), ("'two/x.S'", 5)]
)
def test_a_node_is_named_by_number_path_name_or_type(name: str, uid: int) -> None:
    _, [said] = answers(f"freeze {name}", tree=tree_of(SHARED, SUB))
    assert said.startswith(f"#{uid} ")


def test_a_name_of_several_instances_is_refused_with_their_paths() -> None:
    _, [said] = answers("freeze x.S", tree=tree_of(SHARED, SUB))
    assert said.startswith("2 nodes are called 'x.S': #3 one/x.S, #5 two/x.S; ")


def test_help_lists_what_the_console_takes_and_nothing_else() -> None:
    tree = tree_of(BODY)
    console = Console(tree, Debugger(print))
    lines = console.answer("help").splitlines()[:-1]
    assert all(console.takes(line.split(":")[0]) for line in lines)
    assert console.answer("help force") in lines
    for other in ("", "  ", "break a.S", "quit", "speed := 1", "forced"):
        assert not console.takes(other)
    assert console.answer("where") == ""
    assert console.answer("ahead") == "nothing more in this tick"
