"""The catalogue, the classes and the reference page say the same."""

from __future__ import annotations

from tests.tree_gardener.reference_page import PAGE, page
from tree_gardener import catalog
from tree_gardener.registry import BUILT_IN, built_in_types
from tree_gardener.ros_nodes import NODES as ROS_NODES


def test_the_page_is_current() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(), "run: python -m tests.tree_gardener.reference_page"


def test_catalogue_and_classes_name_the_same_nodes() -> None:
    nodes = catalog.load()
    assert set(nodes) == set(BUILT_IN) | set(ROS_NODES)
    for name, node in nodes.items():
        assert built_in_types()[name].kind.value.lower() == node.kind
        assert node.summary
        assert node.symbol
        assert all(port.description for port in node.ports)


def test_every_rule_is_written_down() -> None:
    for cls in {*BUILT_IN.values(), *ROS_NODES.values()}:
        assert len(cls.__doc__ or "") > 10, cls
