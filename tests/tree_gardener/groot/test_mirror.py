"""Copies of a tree: statuses, scopes and transitions."""

from __future__ import annotations

import sys

import msgpack
import pytest

from tests.tree_gardener.trees import subtree
from tree_gardener import Tree, register_type
from tree_gardener.groot.mirror import MOST_TRANSITIONS, Mirror

BODY = subtree("Body", '<Script code="a := 1; b := 2"/>')
MAIN = subtree("Main", '<Sequence><SubTree ID="Body" name="in"/><UnsetBlackboard key="c"/></Sequence>')
XML = f"<root main_tree_to_execute='Main'>{BODY}{MAIN}</root>"


def test_a_mirror_that_follows_ticks_is_as_one_that_reads_the_tree() -> None:
    tree = Tree.from_xml(XML)
    follows, reads = Mirror(tree, msgpack.packb), Mirror(tree, msgpack.packb)
    tree.observe(follows.ticked)
    tree.blackboard.set("c", 3)
    follows.read()
    assert follows.blackboards(["Main", "in", "", "none"]) == {"Main": {"c": 3}, "in": None, "": {"c": 3}}
    tree.tick_exactly_once()
    reads.read()
    assert (
        follows.blackboards(["Main", "in"])
        == reads.blackboards(["Main", "in"])
        == {
            "Main": None,
            "in": {"a": 1, "b": 2},
        }
    )
    assert follows.statuses().hex() == "01000c02000c04000c03000c"


def test_the_last_transitions_are_kept() -> None:
    tree = Tree.from_xml(XML)
    mirror = Mirror(tree, msgpack.packb)
    tree.observe(mirror.ticked)
    mirror.start_recording()
    for _ in range(MOST_TRANSITIONS):
        tree.tick_exactly_once()
    assert len(mirror.take_transitions()) == 9 * MOST_TRANSITIONS


class Odd:
    """A value of a type whose conversion fails."""


class Leaving:
    """A value of a type whose conversion ends the program."""


register_type(Odd, to_json=lambda value: value.missing)
register_type(Leaving, to_json=lambda value: sys.exit(3))


@pytest.mark.parametrize("value", [2**70, "\ud800", Odd(), Leaving(), object(), [[1]]])
def test_a_value_that_cannot_be_sent_is_nothing(value: object) -> None:
    tree = Tree.from_xml(XML)
    follows, reads = Mirror(tree, msgpack.packb), Mirror(tree, msgpack.packb)
    tree.observe(follows.ticked)
    tree.blackboard.set("odd", value)
    tree.blackboard.set("text", "é")
    tree.tick_exactly_once()
    reads.read()
    for mirror in (follows, reads):
        assert mirror.blackboards(["Main"]) == {"Main": {"odd": None, "text": "é"}}
