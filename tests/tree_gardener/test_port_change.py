"""Ports that get another text while the tree runs."""

from __future__ import annotations

from typing import Any, ClassVar

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.trees import LEAVES, document, load, subtree
from tree_gardener import Port, PortEffect, PortRefusedError, Status, Tree, get_input, set_output, set_port


class Reading(py_trees.behaviour.Behaviour):
    INPUT_PORTS: ClassVar = {
        "speed": Port(float, default=0.5),
        "needed": Port(int, required=True),
    }
    OUTPUT_PORTS: ClassVar = {"told": Port(float)}

    def update(self) -> PyTreesStatus:
        self.seen = get_input(self, "speed")
        return PyTreesStatus.RUNNING


class Telling(Reading):
    def update(self) -> PyTreesStatus:
        set_output(self, "told", 1.5)
        return PyTreesStatus.RUNNING


class AtSetup(Reading):
    def setup(self, **_: Any) -> None:
        self.seen = get_input(self, "speed")

    def update(self) -> PyTreesStatus:
        return PyTreesStatus.RUNNING


class AtSetupAndLater(AtSetup):
    def update(self) -> PyTreesStatus:
        return Reading.update(self)


class Older(py_trees.behaviour.Behaviour):
    def __init__(self, name: str, ports: Any) -> None:
        super().__init__(name)
        self.ports = ports
        self.at_start = ports["start"]

    def update(self) -> PyTreesStatus:
        self.seen = self.ports["speed"]
        return PyTreesStatus.RUNNING


class Copying(py_trees.behaviour.Behaviour):
    def __init__(self, name: str, ports: Any) -> None:
        super().__init__(name)
        self.copy = dict(ports)

    def update(self) -> PyTreesStatus:
        return PyTreesStatus.RUNNING


NODES = {cls.__name__: cls for cls in (Reading, Telling, AtSetup, AtSetupAndLater, Older, Copying)}


def running(body: str) -> Tree:
    tree = load(body, nodes={**LEAVES, **NODES})
    tree.setup()
    tree.tick_exactly_once()
    return tree


def refusal(tree: Tree, port: str, text: str | None, index: int = 0) -> Any:
    with pytest.raises(PortRefusedError) as refused:
        set_port(tree.nodes[index], port, text)
    return refused.value.diagnostic


def test_an_action_has_the_text_at_its_next_tick() -> None:
    tree = running("<Reading needed='1' speed='0.2'/>")
    node = tree.nodes[0]
    assert node.behaviour.seen == 0.2
    assert set_port(node, "speed", "0.9") is PortEffect.NEXT_TICK
    assert node.behaviour.seen == 0.2
    tree.tick_exactly_once()
    assert node.behaviour.seen == 0.9
    tree.blackboard["fast"] = 2.0
    set_port(node, "speed", "{fast}")
    tree.tick_exactly_once()
    assert node.behaviour.seen == 2.0
    set_port(node, "speed", None)
    tree.tick_exactly_once()
    assert node.behaviour.seen == 0.5, "the default"


def test_an_output_leads_to_another_entry() -> None:
    tree = running("<Telling needed='1' told='{a}'/>")
    set_port(tree.nodes[0], "told", "{b}")
    tree.tick_exactly_once()
    assert (tree.blackboard["a"], tree.blackboard["b"]) == (1.5, 1.5)


def test_a_decorator_counts_to_another_number() -> None:
    tree = running("<Repeat num_cycles='3'><Succeeding/></Repeat>")
    set_port(tree.nodes[0], "num_cycles", "2")
    assert tree.tick_exactly_once() is Status.SUCCESS


def test_two_instances_of_a_tree_have_ports_of_their_own() -> None:
    body = "<Sequence><SubTree ID='Part' name='a'/><SubTree ID='Part' name='b'/></Sequence>"
    text = document(body, subtree("Part", "<Reading name='go' needed='1' speed='0.1'/>"))
    tree = Tree.from_xml(text, NODES)
    first, second = (node for node in tree.nodes if node.type == "Reading")
    assert (first.path, second.path) == ("a/go", "b/go")
    set_port(first, "speed", "0.7")
    assert (first.get("speed"), second.get("speed")) == (0.7, 0.1)


def test_an_action_that_read_its_port_before_the_first_tick_has_the_text_at_its_next_start() -> None:
    tree = running("<AtSetup needed='1' speed='0.2'/>")
    assert set_port(tree.nodes[0], "speed", "0.9") is PortEffect.NEXT_START
    assert tree.nodes[0].behaviour.seen == 0.2
    tree = running("<AtSetupAndLater needed='1' speed='0.2'/>")
    assert set_port(tree.nodes[0], "speed", "0.9") is PortEffect.NEXT_TICK


def test_an_older_action_has_the_text_where_it_reads_its_ports_later() -> None:
    tree = running("<Older start='x' speed='1'/>")
    node = tree.nodes[0]
    assert set_port(node, "speed", "{key}") is PortEffect.NEXT_TICK
    tree.tick_exactly_once()
    assert node.behaviour.seen == "{key}"
    assert node.behaviour.seen.board is tree.blackboard
    assert set_port(node, "start", "y") is PortEffect.NEXT_START
    assert node.behaviour.at_start == "x"
    copying = running("<Copying speed='1'/>").nodes[0]
    assert set_port(copying, "speed", "2") is PortEffect.NEXT_START


@pytest.mark.parametrize(
    ("port", "text", "code", "message"),
    [
        ("speed", "quick", "TG305", "the port 'speed' takes a number: 'quick' is not a number"),
        ("speed", "{open", "TG303", "'{open' opens a brace and does not close it"),
        ("told", "1", "TG304", "the output port 'told' needs an entry, not '1'"),
        ("told", "{name}", "TG306", "the entry 'name' is a whole number elsewhere and a number here"),
        ("needed", None, "TG302", "the port 'needed' of Reading needs a value"),
        ("other", "1", "TG301", "Reading has no port 'other'"),
    ],
)
def test_a_wrong_text_is_refused_as_at_load(port: str, text: str | None, code: str, message: str) -> None:
    tree = running("<Reading _bts_id='n7' needed='{name}' speed='0.2'/>")
    found = refusal(tree, port, text)
    assert (found.code, found.message) == (code, message)
    assert (found.tree, found.node, found.node_id, found.port) == ("Main", "Reading", "n7", port)
    assert tree.nodes[0].ports == {"needed": "{name}", "speed": "0.2"}
    if text is not None:
        with pytest.raises(Exception, match=code):
            load(f"<Reading needed='{{name}}' {port}='{text}'/>", nodes=NODES)


@pytest.mark.parametrize(
    ("body", "port"),
    [
        ("<Script code='a := 1'/>", "code"),
        ("<ScriptCondition code='true'/>", "code"),
        ("<Precondition if='true'><Succeeding/></Precondition>", "if"),
        ("<WasEntryUpdated entry='{a}'/>", "entry"),
        ("<SkipUnlessUpdated entry='{a}'><Succeeding/></SkipUnlessUpdated>", "entry"),
    ],
)
def test_a_port_that_is_read_at_load_is_refused(body: str, port: str) -> None:
    found = refusal(running(body), port, "1")
    assert (found.code, found.hint) == ("TG308", "start the program again to use the new value")


def test_the_ports_of_a_subtree_are_read_at_load() -> None:
    text = document("<SubTree ID='Part' x='1'/>", subtree("Part", "<Succeeding/>"))
    assert refusal(Tree.from_xml(text, LEAVES), "x", "2").code == "TG308"


def test_an_open_action_takes_any_port_but_its_name() -> None:
    tree = running("<Copying speed='1'/>")
    assert set_port(tree.nodes[0], "extra", "1") is PortEffect.NEXT_TICK
    assert refusal(tree, "name", "1").code == "TG301"
    assert refusal(tree, "_skipIf", "1").code == "TG301"
