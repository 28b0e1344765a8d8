"""The table of the built-in nodes."""

from __future__ import annotations

from tree_gardener import catalog
from tree_gardener.ports import NO_DEFAULT


def test_a_node_has_its_ports_with_types_and_defaults() -> None:
    repeat = catalog.load()["Repeat"]
    assert (repeat.kind, repeat.min_children, repeat.max_children) == ("decorator", 1, 1)
    spec = repeat.manifest["num_cycles"]
    assert (spec.type.name, spec.default) == ("int", NO_DEFAULT)


def test_types_are_unique_and_explained() -> None:
    nodes = catalog.load()
    assert all(name == node.type and node.summary for name, node in nodes.items())
    assert len({node.symbol for node in nodes.values()}) > 5
