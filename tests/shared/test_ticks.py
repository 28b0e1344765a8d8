"""The stored ticks, to which the page's explanations are held, are those of the engine."""

from __future__ import annotations

from tests.shared.make_ticks import FILE, cases, text
from tree_gardener.node import Control
from tree_gardener.registry import BUILT_IN


def test_the_ticks_are_up_to_date():
    assert FILE.read_text(encoding="utf-8") == text(), "run python -m tests.shared.make_ticks"


def test_each_built_in_node_with_children_is_among_them():
    kinds = {kind for case in cases() for _, _, kind, *_ in case["nodes"]}
    wanted = {name.rstrip("23456") for name, cls in BUILT_IN.items() if issubclass(cls, Control)}
    assert {name for name in wanted if not any(kind.startswith(name) for kind in kinds)} <= {
        "LoopDouble",
        "LoopString",
        "LoopBool",
    }
    assert {"Turns", "Sometimes"} <= kinds


def test_each_pre_condition_and_a_halt_are_among_them():
    found = cases()
    assert {name for case in found for node in case["nodes"] for name in node[4]} == {
        "_failureIf",
        "_successIf",
        "_skipIf",
        "_while",
    }
    assert any("halt" in tick for case in found for tick in case["ticks"])
