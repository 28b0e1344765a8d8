"""The table of Nav2's nodes: each is there, and has Nav2's ports."""

from __future__ import annotations

import pytest

from translator import inspect_action
from tree_gardener.nav2 import NODES
from tree_gardener.nav2_library import source_of, table

TYPES = {
    "double": "double",
    "float": "double",
    "bool": "bool",
    "string": "string",
    "vector<int>": "list[int]",
    **dict.fromkeys(("int", "uint16", "unsigned int", "chrono::milliseconds"), "int"),
}


def test_each_node_is_there() -> None:
    assert NODES.keys() == table().keys()


@pytest.mark.parametrize("name", NODES)
def test_a_node_has_the_kind_and_the_ports_of_the_table(name: str) -> None:
    source, row = source_of(name), table()[name]
    assert source is not None
    found = inspect_action(source, f"actions/{name}.py")
    assert found.diagnostics == ()
    assert found.kind == row["kind"]
    expected = {
        port["name"]: (port["direction"], TYPES.get(port["type"], "any"), port.get("default"))
        for port in row["ports"]
    }
    ports = {port.name: (port.direction, port.type, port.default) for port in found.ports}
    assert ports == expected
