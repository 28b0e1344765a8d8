from __future__ import annotations

import pytest

from tests.tree_gardener.testing.trees_under_test import MODELS, document
from tree_gardener.clock import ManualClock
from tree_gardener.errors import TickError
from tree_gardener.status import FAILURE, RUNNING, SUCCESS
from tree_gardener.testing.cases import Double, Step
from tree_gardener.testing.doubles import (
    DoubleBehaviour,
    LeafModel,
    candidates,
    leaf_models,
    matching,
    refused_result,
    stub_class,
)
from tree_gardener.tree import Tree

STUBS = {name: stub_class(name, model) for name, model in MODELS.items()}


def tree(body):
    return Tree.from_xml(document(body), STUBS, ManualClock())


def test_models_survive_the_way_through_json():
    assert leaf_models({name: model.to_json() for name, model in MODELS.items()}) == MODELS


def test_a_stub_has_ports_and_kind_of_the_leaf_and_refuses_its_tick():
    built = tree('<Turn angle="{a}"/>')
    assert list(built.nodes[0].manifest) == ["speed", "angle"]
    with pytest.raises(TickError, match="has no double"):
        built.tick_exactly_once()


def test_the_most_exact_double_wins():
    node = tree('<Sequence><Drive name="a"/></Sequence>').nodes[1]
    by = {key: Double(key) for key in ("*", "Drive", "a", "Dr*")}
    assert matching((by["*"], by["Drive"], by["a"]), node) is by["a"]
    assert matching((by["*"], by["Drive"]), node) is by["Drive"]
    assert matching((by["Dr*"], by["*"]), node) is by["Dr*"]
    assert matching((Double("Turn"),), node) is None


def test_a_condition_and_a_synchronous_action_cannot_run_on():
    nodes = tree("<Sequence><Near/><Note/><Drive/></Sequence>").nodes
    on = Double("x", (Step(SUCCESS), Step(RUNNING)))
    assert [refused_result(node, on) for node in nodes[1:]] == [RUNNING, RUNNING, None]


def test_a_timed_double_begins_again_with_each_start():
    built = tree('<Timeout msec="100"><Drive/></Timeout>')
    leaf = built.nodes[1]
    behaviour = DoubleBehaviour(leaf, Double("x", (Step(RUNNING), Step(SUCCESS)), for_s=0.2))
    leaf.bind(behaviour)
    results = []
    for _ in range(5):
        results.append(built.tick_exactly_once().name)
        built.clock.sleep(0.05)
    assert results == ["RUNNING", "RUNNING", "FAILURE", "RUNNING", "RUNNING"]
    assert behaviour.halts == 1


def test_candidates_are_found_by_path_name_type_and_id():
    nodes = tree('<Sequence _bts_id="n1"><Drive name="a"/><Drive name="b"/></Sequence>').nodes
    assert candidates(nodes, "a") == [nodes[1]]
    assert candidates(nodes, "Drive") == [nodes[1], nodes[2]]
    assert candidates(nodes, "n1") == [nodes[0]]
    assert candidates(nodes, "c") == []


def test_an_open_leaf_takes_any_port():
    cls = stub_class("Any", LeafModel())
    assert Tree.from_xml(document('<Any x="1" y="{z}"/>'), {"Any": cls}).nodes[0].ports == {
        "x": "1",
        "y": "{z}",
    }


def played(body, steps, ticks):
    built = tree(body)
    leaf = next(node for node in built.nodes if node.type == "Drive")
    seen = []

    class Watched(DoubleBehaviour):
        def update(self):
            status = super().update()
            seen.append((built.tick_number, status))
            return status

    leaf.bind(Watched(leaf, Double("x", steps)))
    for _ in range(ticks):
        built.tick_exactly_once()
    return [(tick, status.name) for tick, status in seen]


def test_results_by_tick_hold_from_their_tick_on_however_often_the_leaf_was_ticked():
    steps = (Step(RUNNING, at=2), Step(SUCCESS, at=4), Step(FAILURE, at=5))
    every = played("<Drive/>", steps, 6)
    assert [status for _, status in every] == [
        *("RUNNING", "RUNNING", "RUNNING"),
        *("SUCCESS", "FAILURE", "FAILURE"),
    ]
    waiting = played('<Delay delay_msec="1"><Drive/></Delay>', steps, 1)
    assert waiting == []


def test_several_results_of_one_tick_follow_each_other_and_the_last_one_stays():
    built = tree("<Drive/>")
    leaf = built.nodes[0]
    steps = (Step(FAILURE, at=1), Step(FAILURE, at=3), Step(SUCCESS, at=3))
    behaviour = DoubleBehaviour(leaf, Double("x", steps))
    for tick, results in ((1, "FF"), (2, "FF"), (3, "FSS"), (4, "SS")):
        built.tick_number = tick
        assert "".join(behaviour.update().name[0] for _ in results) == results
