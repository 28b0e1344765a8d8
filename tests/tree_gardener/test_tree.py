"""Tick functions, hooks, timers, several documents, depth."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, Any

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.budget import count
from tests.tree_gardener.trees import LEAVES, document, leaf, load, recording, subtree
from tree_gardener import LoadError, ManualClock, Status, TickError, Tree

if TYPE_CHECKING:
    from pathlib import Path

    from tree_gardener.node import Node

R, S, F = PyTreesStatus.RUNNING, PyTreesStatus.SUCCESS, PyTreesStatus.FAILURE


def test_tick_while_running_sleeps_by_the_clock_and_wakes_for_timers() -> None:
    clock = ManualClock()
    tree = load('<Delay delay_msec="250"><Succeeding/></Delay>', clock=clock)
    assert tree.tick_while_running(1000) is Status.SUCCESS
    assert clock.now() == pytest.approx(0.25)


def test_tick_while_running_with_the_computers_clock() -> None:
    tree = load('<Sleep msec="20"/>')
    start = time.monotonic()
    assert tree.tick_while_running(5) is Status.SUCCESS
    assert time.monotonic() - start >= 0.019


def test_wake_ends_a_sleep() -> None:
    tree = load("<Running/>", clock=ManualClock())
    tree.wake()
    tree.sleep(3600)
    assert tree.clock.now() == 0.0


def test_a_hook_before_a_node_takes_its_place() -> None:
    tree = load('<Sequence><A name="a"/><Succeeding/></Sequence>', nodes={"A": recording(S)})
    remove = tree.add_hook(before=lambda node: Status.FAILURE, node=2)
    assert tree.tick_exactly_once() is Status.FAILURE
    assert leaf(tree, "a").calls == []
    remove()
    remove()
    assert tree.tick_exactly_once() is Status.SUCCESS


def test_a_hook_after_a_node_replaces_its_result() -> None:
    tree = load("<Inverter><Sequence><Succeeding/></Sequence></Inverter>")
    seen: list[tuple[str, Status]] = []

    def after(node: Node, status: Status) -> Status | None:
        seen.append((node.type, status))
        return Status.FAILURE if node.type == "Sequence" else None

    tree.add_hook(after=after)
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert seen == [
        ("Succeeding", Status.SUCCESS),
        ("Sequence", Status.SUCCESS),
        ("Inverter", Status.SUCCESS),
    ]


@pytest.mark.parametrize("status", [Status.SUCCESS, Status.FAILURE, Status.SKIPPED, Status.RUNNING])
def test_a_hook_can_give_a_running_node_any_result(status: Status) -> None:
    tree = load("<Sequence><Running/></Sequence>")
    tree.tick_exactly_once()
    tree.add_hook(before=lambda node: status, node=tree.nodes[0])
    assert tree.tick_exactly_once() is status


def test_a_hook_must_not_return_idle() -> None:
    tree = load("<Succeeding/>")
    tree.add_hook(before=lambda node: Status.IDLE)
    with pytest.raises(ValueError, match="IDLE"):
        tree.tick_exactly_once()


def test_hooks_do_not_disturb_what_nodes_remember() -> None:
    tree = load(
        "<Sequence><Succeeding/><RunOnce><A name='a'/></RunOnce></Sequence>", nodes={"A": recording(R, S)}
    )
    tree.tick_exactly_once()
    tree.add_hook(before=lambda node: None)()
    tree.tick_exactly_once()
    tree.tick_exactly_once()
    assert leaf(tree, "a").calls.count("update") == 2


def test_nodes_say_where_they_are() -> None:
    tree = load(
        '<Sequence _bts_id="n1"><SubTree ID="Arm" name="left"/><SubTree ID="Arm"/></Sequence>',
        subtree("Arm", "<Inverter><Succeeding name='grip'/></Inverter>"),
    )
    assert [
        (node.uid, node.parent.uid if node.parent else 0, node.path, node.tree_id) for node in tree.nodes
    ] == [
        (1, 0, "Sequence::1", "Main"),
        (2, 1, "left", "Main"),
        (3, 2, "left/Inverter::3", "Arm"),
        (4, 3, "left/grip", "Arm"),
        (5, 1, "Arm::5", "Main"),
        (6, 5, "Arm::5/Inverter::6", "Arm"),
        (7, 6, "Arm::5/grip", "Arm"),
    ]
    assert tree.nodes[0].node_id == "n1"
    assert repr(tree.nodes[3]) == "<Succeeding 'left/grip' IDLE>"
    tree.blackboard.scope("left")["x"] = 1
    assert tree.blackboard.scope("left")["x"] == 1
    assert tree.blackboard.scope("") is tree.blackboard
    with pytest.raises(KeyError):
        tree.blackboard.scope("nowhere")


def test_including_and_registering_documents(tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    arm = subtree("Arm", '<SubTree ID="Hand"/>')
    (tmp_path / "sub" / "arm.xml").write_text(f"<root><include path='hand.xml'/>{arm}</root>")
    (tmp_path / "sub" / "hand.xml").write_text(f"<root>{subtree('Hand', '<Succeeding/>')}</root>")
    main = document(
        '<Sequence><SubTree ID="Arm"/><SubTree ID="Leg"/></Sequence>', "<include path='sub/arm.xml'/>"
    )
    (tmp_path / "main.xml").write_text(main)
    leg = f"<root>{subtree('Leg', '<Succeeding/>')}</root>"
    tree = Tree.from_file(tmp_path / "main.xml", LEAVES, documents=[leg])
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert len(tree.nodes) == 6


@pytest.mark.parametrize(
    ("include", "message"),
    [
        ("<include path='no.xml'/>", "cannot be read"),
        ("<include path='main.xml'/>", "includes itself"),
        ("<include path='x.xml' ros_pkg='no_such_package'/>", "not installed"),
    ],
)
def test_an_include_that_fails_is_located(tmp_path: Path, include: str, message: str) -> None:
    path = tmp_path / "main.xml"
    path.write_text(f"<root>\n  {include}\n{subtree('Main', '<Succeeding/>')}</root>")
    with pytest.raises(LoadError, match=message) as refused:
        Tree.from_file(path, LEAVES)
    assert refused.value.diagnostics[0].line in (2, 1)
    with pytest.raises(LoadError, match=r"base_path|not installed"):
        Tree.from_xml(path.read_text(), LEAVES)


def test_the_main_tree_can_be_chosen() -> None:
    text = f"<root>{subtree('A', '<Succeeding/>')}{subtree('B', '<Failing/>')}</root>"
    assert Tree.from_xml(text, LEAVES, main_tree="B").tick_exactly_once() is Status.FAILURE
    with pytest.raises(LoadError, match="the trees are: A, B"):
        Tree.from_xml(text, LEAVES, main_tree="C")


def deep_document(depth: int, inner: str) -> str:
    trees = "".join(subtree(f"T{n}", f'<SubTree ID="T{n + 1}"/>') for n in range(depth))
    return f'<root main_tree_to_execute="T0">{trees}{subtree(f"T{depth}", inner)}</root>'


def test_thousands_of_levels_of_subtrees_run_observe_hook_and_halt() -> None:
    levels = count("engine_levels")
    assert levels > 2 * sys.getrecursionlimit()
    before = sys.getrecursionlimit()
    tree = Tree.from_xml(deep_document(levels, "<Running/>"), LEAVES)
    assert tree.depth == levels + 1
    assert tree.tick_exactly_once() is Status.RUNNING
    changes: list[Any] = []
    tree.observe(changes.append)
    tree.add_hook(before=lambda node: None)
    assert tree.tick_once() is Status.RUNNING
    assert len(changes[0].changed) == levels + 1
    tree.halt()
    assert all(node.status is Status.IDLE for node in tree.nodes)
    assert sys.getrecursionlimit() == before


def test_an_error_deep_down_is_a_tick_error_as_any() -> None:
    tree = Tree.from_xml(deep_document(3_000, "<Raising/>"), LEAVES)
    with pytest.raises(TickError, match="out of order"):
        tree.tick_once()


def test_py_trees_tools_work_on_the_tree() -> None:
    tree = load(
        "<Sequence><Fallback><Failing/><Succeeding name='ok'/></Fallback>"
        "<ParallelAll><Inverter><Failing/></Inverter></ParallelAll><Running name='drive'/>"
        "<Script code='x:=1'/></Sequence>"
    )
    text = py_trees.display.ascii_tree(tree.root, show_status=True)
    assert "drive [-]" in text
    visitor = py_trees.visitors.SnapshotVisitor()
    behaviour_tree = py_trees.trees.BehaviourTree(tree.root)
    behaviour_tree.visitors.append(visitor)
    behaviour_tree.setup(node=None)
    behaviour_tree.tick()
    assert behaviour_tree.root.status is R
    statuses = {node.name: node.status for node in behaviour_tree.root.iterate()}
    assert (statuses["ok"], statuses["drive"], statuses["Fallback"]) == (S, R, S)
    assert leaf(tree, "drive").id in visitor.visited
    assert py_trees.display.dot_tree(tree.root).get_nodes()
    behaviour_tree.root.stop(py_trees.common.Status.INVALID)
    assert tree.nodes[0].status is Status.IDLE
    behaviour_tree.root.tick_once()
    assert behaviour_tree.root.status is R


def test_substitution_rules_replace_nodes() -> None:
    rules = {
        "TestNodeConfigs": {"ko": {"return_status": "FAILURE", "failure_script": "why := 'test'"}},
        "SubstitutionRules": {"Arm::2/*": "ko", "third": "AlwaysFailure"},
    }
    tree = load(
        '<Fallback><SubTree ID="Arm"/><Succeeding name="third"/></Fallback>',
        subtree("Arm", "<Succeeding/>"),
        substitutions=rules,
    )
    assert tree.tick_exactly_once() is Status.FAILURE
    assert tree.blackboard.scope("Arm::2")["why"] == "test"


def test_a_test_node_takes_its_time_and_its_status_from_a_script() -> None:
    config = '{"t": {"return_status_script": "x", "async_delay": 100}}'
    rules = f'{{"TestNodeConfigs": {config}, "SubstitutionRules": {{"a": "t"}}}}'
    clock = ManualClock()
    tree = load('<Succeeding name="a"/>', substitutions=rules, clock=clock)
    tree.blackboard["x"] = "SKIPPED"
    assert tree.tick_exactly_once() is Status.RUNNING
    clock.advance(0.1)
    assert tree.tick_exactly_once() is Status.SKIPPED
