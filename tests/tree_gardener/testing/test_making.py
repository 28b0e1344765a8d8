"""A test that was made of a run passes against the same tree, and fails against another."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING, Any

import pytest

from tests.tree_gardener.testing.random_trees import LEAVES, RandomLeaf, random_tree
from tests.tree_gardener.testing.trees_under_test import document
from tree_gardener.clock import ManualClock
from tree_gardener.errors import TickError
from tree_gardener.status import IDLE, Status
from tree_gardener.testing import LeafModel, Suite, read_tests
from tree_gardener.testing.making import Maker
from tree_gardener.tree import Tree

if TYPE_CHECKING:
    from tree_gardener.observe import TickChanges

MODELS = {
    "Act": LeafModel("Action", (("output", "value", "double", None),), open=False),
    "Check": LeafModel("Condition", (("output", "value", "double", None),), open=False),
}


def observed(body, seed, ticks=60):
    clock = ManualClock()
    tree = Tree.from_xml(document(body), LEAVES, clock)
    tree.setup()
    for node in tree.nodes:
        if isinstance(leaf := getattr(node, "instance_behaviour", None), RandomLeaf):
            leaf.chance = random.Random(seed * 1000 + node.uid)  # noqa: S311 - a reproducible tree, no secret
    maker = Maker(tree, 20.0)
    for number in range(ticks):
        clock.sleep(number / 20.0 - clock.now())
        try:
            maker.after_tick(tree.tick_exactly_once())
        except TickError:  # the condition of an IfThenElse must not be skipped
            break
    return maker


@pytest.mark.parametrize("seed", range(200))
def test_a_made_test_passes_against_the_same_tree(seed):
    body = random_tree(random.Random(seed))  # noqa: S311 - a reproducible tree, no secret
    maker = observed(body, seed)
    if not maker.ticks:
        return
    suite = Suite(document(body), MODELS)
    cases, problems = read_tests(maker.document("made"), suite=suite)
    assert problems == []
    assert maker.problems == []
    assert [str(failure) for failure in suite.run(cases[0]).failures] == []


def test_it_fails_against_a_tree_that_decides_otherwise():
    body = '<Fallback><Check name="a" value="{v}"/><Act name="b" value="{w}"/></Fallback>'
    maker = observed(body, 3)
    suite = Suite(document(body.replace("Fallback", "Sequence")), MODELS)
    cases, _ = read_tests(maker.document("made"), suite=suite)
    assert not suite.run(cases[0]).passed


def test_leaves_with_the_same_path_are_named():
    maker = observed('<Sequence><Act name="a" value="{v}"/><Act name="a" value="{w}"/></Sequence>', 1)
    maker.test("made")
    assert maker.problems == ["several nodes are called 'a': give them different names"] * 2


def recorded(body, seed, ticks=60):
    """Returns the doubles that the page makes of a recording, the statuses at each tick, and the root's."""
    clock = ManualClock()
    tree = Tree.from_xml(document(body), LEAVES, clock)
    tree.setup()
    leaves = {}
    for node in tree.nodes:
        if isinstance(leaf := getattr(node, "instance_behaviour", None), RandomLeaf):
            leaf.chance = random.Random(seed * 1000 + node.uid)  # noqa: S311 - a reproducible tree, no secret
            leaves[node.uid] = node.name
    steps: dict[str, list[dict[str, Any]]] = {name: [] for name in leaves.values()}
    statuses: list[list[Status]] = []
    roots: list[Status] = []
    seen: list[TickChanges] = []
    tree.observe(seen.append)
    for number in range(1, ticks + 1):
        clock.sleep((number - 1) / 20.0 - clock.now())
        try:
            roots.append(tree.tick_exactly_once())
        except TickError:
            break
        changes = seen[-1]
        statuses.append([node.status for node in tree.nodes])
        for uid, name in leaves.items():
            results = [status for each, status in changes.flashed if each == uid]
            if statuses[-1][uid - 1] is not IDLE:
                results.append(statuses[-1][uid - 1])
            values = [entry.value for entry in changes.blackboard if entry.writer_uid == uid]
            written = {"value": values[-1]} if values else {}
            for index, status in enumerate(results):
                outputs = written if index == len(results) - 1 else {}
                step = {"at": number, "status": status.name, "outputs": outputs}
                last = steps[name][-1] if steps[name] else {}
                if len(results) > 1 or {**last, "at": number} != step:
                    steps[name].append(step)
    return {name: each for name, each in steps.items() if each}, statuses, roots


@pytest.mark.parametrize("seed", range(100))
def test_results_by_tick_repeat_what_a_recording_tells(seed):
    body = random_tree(random.Random(seed))  # noqa: S311 - a reproducible tree, no secret
    doubles, statuses, roots = recorded(body, seed)
    if not roots:
        return
    suite = Suite(document(body), MODELS)
    nodes = Tree.from_xml(document(body), LEAVES, ManualClock()).nodes
    expect = [
        {"at": tick, "node": node.path, "status": status.name}
        for tick, row in enumerate(statuses, start=1)
        for node, status in zip(nodes, row, strict=True)
    ]
    test = {"name": "recorded", "doubles": doubles, "ticks": len(roots), "repeat": True, "expect": expect}
    cases, problems = read_tests({"format": "bt-studio/test", "version": 1, "tests": [test]}, suite=suite)
    assert problems == []
    assert [str(failure) for failure in suite.run(cases[0]).failures] == []
