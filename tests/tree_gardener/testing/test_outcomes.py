"""The possible results by the rules of the nodes; the engine never returns another one."""

from __future__ import annotations

import random

import pytest

from tests.tree_gardener.testing.random_trees import LEAVES, RandomLeaf, random_tree
from tests.tree_gardener.testing.trees_under_test import MODELS, document
from tree_gardener.clock import ManualClock
from tree_gardener.testing.doubles import stub_class
from tree_gardener.testing.outcomes import haltable, outcomes
from tree_gardener.tree import Tree

STUBS = {name: stub_class(name, model) for name, model in MODELS.items()}
RETURNS = {name: model.returns for name, model in MODELS.items() if model.returns}


def letters(body):
    nodes = Tree.from_xml(document(body), STUBS).nodes
    return "".join(sorted(status.letter for status in outcomes(nodes, RETURNS)[0]))


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("<Near/>", "FS"),
        ("<Turn/>", "FRS"),
        ("<Drive/>", "R"),
        ("<Note/>", "FS"),
        ("<AlwaysSuccess/>", "S"),
        ('<Sleep msec="1"/>', "RS"),
        ("<Sequence><Near/><Drive/></Sequence>", "FR"),
        ("<Sequence><AlwaysFailure/><Drive/></Sequence>", "F"),
        ("<Fallback><AlwaysSuccess/><Drive/></Fallback>", "S"),
        ("<Fallback><Near/><Drive/></Fallback>", "RS"),
        ("<AsyncSequence><Near/><Near/></AsyncSequence>", "FRS"),
        ("<Inverter><AlwaysSuccess/></Inverter>", "F"),
        ("<ForceSuccess><Turn/></ForceSuccess>", "RS"),
        ('<Repeat num_cycles="-1"><AlwaysSuccess/></Repeat>', "R"),
        ('<Repeat num_cycles="2"><Near/></Repeat>', "FRS"),
        ('<RetryUntilSuccessful num_attempts="-1"><Near/></RetryUntilSuccessful>', "RS"),
        ("<KeepRunningUntilFailure><Near/></KeepRunningUntilFailure>", "FR"),
        ("<RunOnce><AlwaysSuccess/></RunOnce>", "KS"),
        ('<Timeout msec="9"><Drive/></Timeout>', "FR"),
        ("<IfThenElse><Near/><Drive/><AlwaysSuccess/></IfThenElse>", "RS"),
        ("<IfThenElse><Near/><AlwaysSuccess/></IfThenElse>", "FS"),
        ("<TryCatch><Near/><Drive/></TryCatch>", "FRS"),
        ('<Near _skipIf="true"/>', "FKS"),
        ('<Drive _failureIf="true" _while="true"/>', "FKR"),
        ('<Precondition if="true" else="SKIPPED"><Near/></Precondition>', "FKS"),
    ],
)
def test_each_rule(body, expected):
    assert letters(body) == expected


def halting(body):
    nodes = Tree.from_xml(document(body), STUBS).nodes
    return [
        node.name for node, can in zip(nodes, haltable(nodes, outcomes(nodes, RETURNS)), strict=True) if can
    ]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("<Sequence><Near/><Drive/></Sequence>", []),
        ("<ReactiveSequence><Near/><Drive/></ReactiveSequence>", ["Drive"]),
        ("<ReactiveSequence><Drive/><Near/></ReactiveSequence>", []),
        ('<Timeout msec="1"><Sequence name="s"><Drive/></Sequence></Timeout>', ["s", "Drive"]),
        ('<Drive _while="true"/>', ["Drive"]),
        ('<Parallel><Drive name="a"/><Turn name="b"/></Parallel>', ["a", "b"]),
        ("<ReactiveSequence><Near/><AlwaysSuccess/></ReactiveSequence>", []),
    ],
)
def test_what_can_be_halted(body, expected):
    assert halting(body) == expected


@pytest.mark.parametrize("seed", range(150))
def test_the_engine_never_returns_another_result(seed):
    chance = random.Random(seed)  # noqa: S311 - a reproducible tree, no secret
    built = Tree.from_xml(document(random_tree(chance)), LEAVES, ManualClock())
    possible = outcomes(built.nodes, {})
    for node in built.nodes:
        if isinstance(leaf := getattr(node, "instance_behaviour", None), RandomLeaf):
            leaf.chance = random.Random(seed + node.uid)  # noqa: S311 - a reproducible tree, no secret
    log = built.log_results()
    for _ in range(60):
        built.tick_exactly_once()
        built.clock.sleep(0.05)
    for uid, status in log:
        assert status in possible[uid - 1], built.nodes[uid - 1]
