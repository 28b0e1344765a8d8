"""A test that was made of a run passes against the same tree, and fails against another."""

from __future__ import annotations

import random

import pytest

from tests.tree_gardener.testing.random_trees import LEAVES, RandomLeaf, random_tree
from tests.tree_gardener.testing.trees_under_test import document
from tree_gardener.clock import ManualClock
from tree_gardener.errors import TickError
from tree_gardener.testing import LeafModel, Suite, read_tests
from tree_gardener.testing.making import Maker
from tree_gardener.tree import Tree

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
