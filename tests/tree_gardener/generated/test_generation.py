"""When code is made, dropped and made again."""

from __future__ import annotations

import itertools
import subprocess
import sys
from typing import Any

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import load, recording
from tree_gardener import Status, Tree
from tree_gardener.clock import ManualClock
from tree_gardener.generated import generation
from tree_gardener.generated.generation import Generation
from tree_gardener.node import Control
from tree_gardener.runner import Runner

R, S, F = PyTreesStatus.RUNNING, PyTreesStatus.SUCCESS, PyTreesStatus.FAILURE
TWO = f"<Sequence><Repeat num_cycles='1'><Sequence><A/><B/></Sequence></Repeat>{'<A/>' * 9}</Sequence>"


def coded(tree: Tree) -> list[int]:
    return [node.uid for node in tree.nodes if isinstance(node, Control) and node.quick is not None]


def test_code_is_made_after_some_ticks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(generation, "WARM_TICKS", 3)
    tree = load("<Sequence><Succeeding/></Sequence>")
    found = []
    for _ in range(5):
        tree.tick_exactly_once()
        found.append(coded(tree))
    assert found == [[], [], [], [1], [1]]


def test_little_is_made_in_one_tick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(generation, "BUDGET_S", -1.0)
    inner = "<Repeat num_cycles='1'><Sequence><Succeeding/></Sequence></Repeat>"
    tree = load(f"<Sequence><Succeeding/>{inner * 3}</Sequence>")
    found = []
    for _ in range(12):
        assert tree.tick_exactly_once() is Status.SUCCESS
        found.append(len(coded(tree)))
    assert found[0] == 1
    assert found[-1] == 4
    assert sorted(found) == found
    assert max(after - before for before, after in itertools.pairwise(found)) == 1


def test_it_can_be_switched_off_and_on() -> None:
    tree = load("<Sequence><Succeeding/></Sequence>")
    tree.tick_exactly_once()
    assert coded(tree) == [1]
    tree.generate_code(on=False)
    tree.tick_exactly_once()
    assert coded(tree) == []
    assert tree.generated_source() == ""
    tree.generate_code(on=True)
    tree.tick_exactly_once()
    assert coded(tree) == [1]


@pytest.mark.parametrize(("value", "expected"), [("0", "False"), ("1", "True"), ("", "True")])
def test_an_environment_variable_switches_it(value: str, expected: str) -> None:
    program = "from tree_gardener.generated import generation; print(generation.ENABLED)"
    found = subprocess.run(
        [sys.executable, "-c", program],
        env={generation.SWITCH: value, "PYTHONPATH": ":".join(sys.path)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert found.stdout.strip() == expected


def test_a_hook_of_one_node_changes_only_the_functions_it_is_in() -> None:
    parts = "<Repeat num_cycles='1'><Sequence><Succeeding/><Succeeding/></Sequence></Repeat>"
    tree = load(f"<Sequence><Succeeding/>{parts * 2}</Sequence>")
    tree.tick_exactly_once()
    assert coded(tree) == [1, 4, 8]
    kept, other = tree.nodes[3].quick, tree.nodes[7].quick  # type: ignore[attr-defined]
    seen: list[int] = []
    remove = tree.add_hook(before=lambda node: seen.append(node.uid), node=5)
    assert coded(tree) == [8]
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert seen == [5]
    assert coded(tree) == [1, 4, 8]
    assert tree.nodes[7].quick is other  # type: ignore[attr-defined]
    assert tree.nodes[3].quick is not kept  # type: ignore[attr-defined]
    remove()
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert seen == [5]
    assert coded(tree) == [1, 4, 8]


def test_hooks_that_come_and_go_without_a_tick_leave_nothing_behind() -> None:
    tree = load("<Sequence><Succeeding/><Succeeding/></Sequence>")
    for _ in range(200):
        tree.add_hook(before=lambda node: None, node=2)()
    assert len(tree._ways.generation.queue) <= len(tree.nodes) + 2
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert coded(tree) == [1]


def test_a_hook_of_the_root_and_of_all_nodes() -> None:
    tree = load("<Sequence><Succeeding/></Sequence>")
    seen: list[int] = []
    remove = tree.add_hook(before=lambda node: seen.append(node.uid), node=1)
    tree.tick_exactly_once()
    assert (seen, coded(tree)) == ([1], [1])
    everywhere = tree.add_hook(before=lambda node: seen.append(-node.uid))
    tree.tick_exactly_once()
    assert (seen, coded(tree)) == ([1, 1, -1, -2], [])
    everywhere()
    remove()
    tree.tick_exactly_once()
    assert (seen, coded(tree)) == ([1, 1, -1, -2], [1])


class Meddling(py_trees.behaviour.Behaviour):
    """Calls a function in its first tick."""

    tree: Any
    act: Any = None

    def update(self) -> PyTreesStatus:
        act, Meddling.act = Meddling.act, None
        if act is not None:
            act()
        return S


def meddle(body: str, act: Any, **nodes: Any) -> tuple[Tree, list[int]]:
    """Ticks twice; in the first tick an action calls `act` with the tree and a list."""
    tree = load(body, nodes={"M": Meddling, **nodes})
    seen: list[int] = []
    tree.tick_exactly_once()
    Meddling.act = lambda: act(tree, seen)
    tree.tick_exactly_once()
    return tree, seen


def test_a_hook_that_comes_within_a_tick_is_called_in_the_next_one_at_the_latest() -> None:
    def act(tree: Tree, seen: list[int]) -> None:
        tree.add_hook(before=lambda node: seen.append(node.uid), node=4)

    tree, seen = meddle("<Sequence><M/><Sequence><Succeeding/></Sequence></Sequence>", act)
    seen.clear()
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert seen == [4]


def test_an_observer_that_comes_within_a_tick_knows_all_statuses_after_the_next_one() -> None:
    reported: dict[int, Status] = {}

    def act(tree: Tree, _seen: list[int]) -> None:
        tree.observe(lambda changes: reported.update(changes.changed))

    slow = recording(S, S, S, R)
    tree, _ = meddle(
        "<Sequence><M/><Succeeding/><A/><Fallback><B/></Fallback></Sequence>", act, A=recording(S, R), B=slow
    )
    tree.tick_exactly_once()
    for node in tree.nodes:
        assert reported.get(node.uid, Status.IDLE) is node.status


def test_a_tree_that_is_halted_within_a_tick_continues_as_without_code() -> None:
    found = []
    for on in (True, False):
        tree = load(
            "<Sequence><M/><Sequence><A name='a'/><M/><B/></Sequence><B/></Sequence>",
            nodes={"M": Meddling, "A": recording(S), "B": recording(R, S)},
        )
        tree.generate_code(on=on)
        changes: list[Any] = []
        tree.observe(changes.append)
        Meddling.act = tree.halt
        results = [tree.tick_exactly_once() for _ in range(4)]
        reports = [(sorted(each.changed, key=str), sorted(each.flashed, key=str)) for each in changes[1:]]
        found.append((results, [node.status for node in tree.nodes], reports))
    assert found[0] == found[1]


def test_marks_counts_and_times_are_in_the_code() -> None:
    tree = load("<Sequence><Succeeding/><Fallback><Failing/><Succeeding/></Fallback></Sequence>")
    counts = tree.count_results()
    tree.time_leaves()
    for _ in range(3):
        tree.tick_exactly_once()
    assert coded(tree) == [1]
    assert [(count.success, count.failure) for count in counts] == [(3, 0), (3, 0), (3, 0), (0, 3), (3, 0)]
    duration_s, uid = tree.slowest
    assert duration_s > 0.0
    assert uid in (2, 4, 5)
    assert tree.current_uid == 0
    source = tree.generated_source()
    assert "CLOCK()" in source
    assert "CURRENT[0]" in source


def test_the_memory_for_the_action_in_progress_can_be_replaced() -> None:
    found: list[int] = []
    memory = memoryview(bytearray(8)).cast("q")

    class Look(py_trees.behaviour.Behaviour):
        def update(self) -> PyTreesStatus:
            found.append(memory[0])
            return S

    tree = load("<Sequence><Succeeding/><Look/></Sequence>", nodes={"Look": Look})
    runner = Runner(tree, tick_hz=10, on_finish="repeat")
    runner.tick_due(0.0)
    tree.current = memory
    runner.tick_due(1.0)
    assert found == [0, 3]
    assert memory[0] == 0
    assert coded(tree) == [1]


def test_times_of_all_nodes_and_logs_leave_the_tree_to_its_methods() -> None:
    tree = load("<Sequence><Succeeding/></Sequence>")
    remove = tree.observe(lambda changes: None, node_times=True)
    tree.tick_exactly_once()
    assert coded(tree) == []
    remove()
    tree.tick_exactly_once()
    assert coded(tree) == [1]
    log = tree.log_results()
    tree.tick_exactly_once()
    assert coded(tree) == []
    assert log == [(2, Status.SUCCESS), (1, Status.SUCCESS)]


@pytest.mark.parametrize(
    "control", ["Sequence", "Fallback", "ReactiveSequence", "ReactiveFallback", "ParallelAll"]
)
@pytest.mark.parametrize("last", [S, F, R])
def test_wide_nodes_have_several_functions(control: str, last: PyTreesStatus) -> None:
    goes = F if control.endswith("Fallback") else S
    found = []
    for on in (True, False):
        nodes = {"A": recording(R, goes, goes), "Z": recording(R, last, last)}
        tree = load(f"<{control}>{'<A/>' * 70}<Z/>{'<A/>' * 9}</{control}>", nodes=nodes)
        tree.generate_code(on=on)
        results = []
        for _ in range(5):
            results.append((tree.tick_exactly_once(), [node.status for node in tree.nodes]))
        assert bool(coded(tree)) is on
        found.append(results)
    assert found[0] == found[1]


def test_very_deep_trees_run() -> None:
    deep = 120
    tree = load("<Sequence>" * deep + "<Succeeding/><Succeeding/>" + "</Sequence>" * deep)
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert coded(tree)


def test_the_source_shows_every_function() -> None:
    tree = load(TWO, nodes={"A": recording(S), "B": recording(S)})
    source = tree.generated_source()
    assert source.count("def tick(") == len(coded(tree)) == 2
    assert source.startswith("# node 1\n")
    assert isinstance(tree._ways.generation, Generation)
    assert load("<Sleep msec='1'/>").generated_source() == ""


def test_a_halt_by_a_timer_is_as_without_code() -> None:

    found = []
    for on in (True, False):
        clock = ManualClock()
        nodes = {"A": recording(S), "B": recording(R)}
        tree = load(
            "<Fallback><Timeout msec='100'><Sequence _onHalted='h := 1'><A name='a'/><B name='b'/></Sequence>"
            "</Timeout><A/></Fallback>",
            nodes=nodes,
            clock=clock,
        )
        tree.generate_code(on=on)
        results = []
        for _ in range(6):
            results.append(
                (tree.tick_exactly_once(), [node.status for node in tree.nodes], dict(tree.blackboard))
            )
            clock.advance(0.04)
            tree.fire_timers()
            results.append((None, [node.status for node in tree.nodes], dict(tree.blackboard)))
        assert bool(coded(tree)) is on
        found.append(results)
    assert found[0] == found[1]
    assert any(entry[2] for entry in found[0])
