"""The results of nodes that were RUNNING before."""

from __future__ import annotations

import pytest

from tests.translator.check.test_order import tree, under
from translator.check.context import Context
from translator.check.results.resumed import resumed
from translator.check.results.sets import F, R, S

WAITS = {"type": "Sleep", "ports": {"msec": "10"}}
TESTS = {"type": "ScriptCondition", "ports": {"code": "z"}}


@pytest.mark.parametrize(
    ("nodes", "result"),
    [
        (WAITS, S | R),
        (TESTS, 0),
        (tree("Sequence", TESTS, WAITS), S | R),
        (tree("Sequence", WAITS, TESTS), S | F | R),
        (tree("Fallback", TESTS, under("Inverter", WAITS)), F | R),
        (tree("ReactiveSequence", TESTS, WAITS), S | R),
        (tree("ParallelAll", TESTS, WAITS), S | F | R),
        (tree("WhileDoElse", TESTS, WAITS, TESTS), S | R),
        (tree("Delay", TESTS, delay_msec="5"), R),
        (tree("Timeout", WAITS, msec="5"), S | F | R),
    ],
)
def test_how_a_node_ends_once_it_has_waited(make_project, nodes, result):
    context = Context(make_project(nodes if "n1" in nodes else {"n1": nodes}))
    main = context.project.trees["MainTree"]
    assert resumed(main, context.results, {})["n1"] == result


def test_called_trees(make_project):
    context = Context(
        make_project({"n1": {"type": "SubTree", "tree": "Other"}}, trees={"Other": {"n1": WAITS}})
    )
    main = context.project.trees["MainTree"]
    assert resumed(main, context.results, {"Other": S})["n1"] == S
