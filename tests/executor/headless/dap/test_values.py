"""Values of a held tree."""

from __future__ import annotations

import contextlib
import io
import json

import pytest

from executor.headless.dap.values import Values, ValuesError, evaluated, shown
from tests.fakes.hostile_values import VALUES
from tree_gardener import Tree
from tree_gardener.blackboard import EMPTY

XML = """<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><Sequence><Script code="speed := 1; name := 'a'"/>
<SubTree ID="Sub" x="{speed}"/></Sequence></BehaviorTree>
<BehaviorTree ID="Sub"><Repeat num_cycles="{x}"><AlwaysSuccess/></Repeat></BehaviorTree></root>"""


class Broken:
    def __repr__(self) -> str:
        raise ValueError("no")


@pytest.fixture
def tree() -> Tree:
    tree = Tree.from_xml(XML)
    tree.tick_exactly_once()
    tree.blackboard["parts"] = {"a": [1, (2, 3)]}
    return tree


def texts(values: Values, reference: int) -> dict[str, str]:
    return {each["name"]: each["value"] for each in values.variables(reference)}


def test_a_node_has_its_ports_and_all_blackboards_round_it(tree: Tree) -> None:
    values = Values()
    node = next(node for node in tree.nodes if node.type == "Repeat")
    scopes = values.scopes(node)
    assert [scope["name"] for scope in scopes] == ["Ports", f"Blackboard of {node.board.path}", "Blackboard"]
    assert texts(values, scopes[0]["variablesReference"]) == {"num_cycles": "1"}
    root = values.variables(scopes[2]["variablesReference"])
    assert {each["name"] for each in root} >= {"speed", "name", "parts"}
    parts = next(each for each in root if each["name"] == "parts")
    [inner] = values.variables(parts["variablesReference"])
    assert (inner["name"], inner["value"], inner["type"]) == ("'a'", "[1, (2, 3)]", "list")
    assert texts(values, inner["variablesReference"]) == {"[0]": "1", "[1]": "(2, 3)"}


def test_an_entry_is_set_in_its_own_blackboard(tree: Tree) -> None:
    values = Values()
    node = next(node for node in tree.nodes if node.type == "Repeat")
    ports, _, root = [scope["variablesReference"] for scope in values.scopes(node)]
    assert values.set(root, "speed", "speed + 1")["value"] == "2"
    assert tree.blackboard["speed"] == 2
    for reference, name, text, why in [
        (root, "speed", "'fast'", "speed"),
        (root, "speed", "x := 3", "only read"),
        (root, "speed", "1 +", "expression|expected|end"),
        (root, "no", "1", "no entry 'no'"),
        (ports, "num_cycles", "1", "only entries"),
        (99, "speed", "1", "has continued"),
    ]:
        with pytest.raises(ValuesError, match=why):
            values.set(reference, name, text)
    assert tree.blackboard["speed"] == 2
    values.forget()
    with pytest.raises(ValuesError, match="has continued"):
        values.variables(root)


def test_keys_and_scripts_are_evaluated(tree: Tree) -> None:
    node = tree.nodes[0]
    assert evaluated("name", node, may_write=False) == "a"
    assert evaluated("speed == 1 && name == 'a'", node, may_write=False) == 1
    evaluated("speed := 7", node, may_write=True)
    assert evaluated(" speed ", node, may_write=False) == 7
    for text in ("speed := 3", "nothing + 1", "(", ""):
        with pytest.raises(ValuesError):
            evaluated(text, node, may_write=False)


def test_any_value_has_a_text() -> None:
    assert shown(EMPTY) == "(empty)"
    assert shown(Broken()) == "<Broken; its repr raised ValueError>"
    assert len(shown("x" * 5000)) == 1000


@pytest.mark.parametrize("number", range(len(VALUES)))
def test_any_value_of_a_user_can_be_looked_at(tree: Tree, number: int) -> None:
    values = Values()
    with contextlib.redirect_stdout(io.StringIO()):
        found = values.described(VALUES[number], tree.nodes[0])
        if found["variablesReference"]:
            found |= {"parts": values.variables(found["variablesReference"])}
    json.dumps(found).encode()
