"""Keys of py_trees' blackboard and behaviours inside of a node, as observers see them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import py_trees
import pytest
from py_trees.blackboard import Blackboard
from py_trees.common import Access
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import load
from tree_gardener.py_trees_board import place_of, write

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture(autouse=True)
def clean_board() -> Iterator[None]:
    Blackboard.clear()
    yield
    Blackboard.clear()


class Counter(py_trees.behaviour.Behaviour):
    """Counts in a namespace, under a remapped name, and removes the key at the third tick."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.client = self.attach_blackboard_client(name=name, namespace="counts")
        self.client.register_key("n", Access.WRITE, remap_to="/totals/number")
        self.client.register_key("own", Access.WRITE)
        self.count = 0

    def update(self) -> PyTreesStatus:
        self.count += 1
        self.client.n = self.count
        if self.count == 1:
            self.client.own = "x"
        if self.count == 3:
            self.client.unset("own")
        return PyTreesStatus.RUNNING


class Holder(py_trees.composites.Sequence):
    """Holds its children itself."""

    def __init__(self, name: str) -> None:
        super().__init__(name, memory=True)
        self.add_children([py_trees.behaviours.Success("a"), py_trees.behaviours.Running("a")])


NODES = {"Counter": Counter, "Holder": Holder}


def changes_of(xml: str, ticks: int) -> list[list[tuple[Any, ...]]]:
    tree = load(xml, nodes=NODES)
    seen: list[list[tuple[Any, ...]]] = []
    tree.observe(
        lambda changes: seen.append(
            [(each.scope, each.key, each.type, each.value, each.removed) for each in changes.blackboard]
        )
    )
    for _ in range(ticks):
        tree.tick_exactly_once()
    return seen


def test_keys_of_clients_are_seen_by_their_absolute_names() -> None:
    first, second, third = changes_of("<Counter/>", 3)
    assert first == [
        ("py_trees:/totals/", "number", "int", 1, False),
        ("py_trees:/counts/", "own", "string", "x", False),
    ]
    assert second == [("py_trees:/totals/", "number", "int", 2, False)]
    assert third == [
        ("py_trees:/totals/", "number", "int", 3, False),
        ("py_trees:/counts/", "own", "empty", None, True),
    ]


def test_behaviours_inside_of_a_node_are_seen_with_their_status() -> None:
    first, second = changes_of("<Holder name='h'/>", 2)
    assert first == [
        ("py_trees:h", "a", "Status", "SUCCESS", False),
        ("py_trees:h", "a (2)", "Status", "RUNNING", False),
    ]
    assert second == []


def test_without_a_client_nothing_is_looked_for() -> None:
    tree = load("<AlwaysSuccess/>")
    tree.observe(lambda _: None)
    assert not tree._recorder.outside.is_used
    assert tree.outside_entries() == {}


def test_a_recorded_value_is_written_under_its_absolute_name() -> None:
    assert place_of("/a/b") == ("py_trees:/a/", "b")
    assert place_of("/b") == ("py_trees:/", "b")
    assert write("py_trees:/a/", "b", 3)
    assert Blackboard.get("/a/b") == 3
    assert not write("py_trees:node", "b", 3)
