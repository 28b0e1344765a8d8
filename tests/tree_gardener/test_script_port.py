"""Scripts in ports: bound once when written in the document, again when an entry's text changes."""

from __future__ import annotations

import pytest

from tree_gardener import Status, TickError, Tree
from tree_gardener.script_port import ScriptPort


def tree(body: str, **entries: object) -> Tree:
    loaded = Tree.from_xml(
        '<root BTCPP_format="4" main_tree_to_execute="Main">'
        f'<BehaviorTree ID="Main"><Sequence>{body}</Sequence></BehaviorTree></root>'
    )
    for key, value in entries.items():
        loaded.blackboard[key] = value
    return loaded


def test_a_script_of_the_document_is_bound_at_load() -> None:
    loaded = tree('<ScriptCondition code="x > 1"/>', x=2)
    script = loaded.nodes[1].script  # type: ignore[attr-defined]
    assert isinstance(script, ScriptPort)
    assert script.fixed is not None
    assert loaded.tick_exactly_once() is Status.SUCCESS
    loaded.blackboard["x"] = 1
    assert loaded.tick_exactly_once() is Status.FAILURE


def test_a_script_in_an_entry_is_bound_again_when_the_text_changes() -> None:
    loaded = Tree.from_xml(
        '<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main">'
        '<SubTree ID="Inner" code="x := 1"/></BehaviorTree>'
        '<BehaviorTree ID="Inner"><Script code="{code}"/></BehaviorTree></root>'
    )
    inner = loaded.nodes[1].board
    loaded.tick_exactly_once()
    assert inner["x"] == 1
    inner["code"] = "x := 2"
    loaded.tick_exactly_once()
    assert inner["x"] == 2
    inner["code"] = ""
    loaded.tick_exactly_once()
    assert inner["x"] == 2
    for _ in range(2):
        inner["code"] = "x := "
        with pytest.raises(TickError, match="in the script 'x := '"):
            loaded.tick_exactly_once()


def test_an_error_names_the_script() -> None:
    with pytest.raises(TickError, match="in the script 'missing > 1': there is no entry 'missing'"):
        tree('<ScriptCondition code="missing > 1"/>').tick_exactly_once()
