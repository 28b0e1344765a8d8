"""Ports of the running tree that the session changes."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import py_trees

from executor.application.changes.live_ports import set_port
from executor.child_messages import PortSet, SetPort
from tests.tree_gardener.trees import document, subtree
from tree_gardener import Port, Tree

if TYPE_CHECKING:
    from executor.messages import Error


class Go(py_trees.behaviour.Behaviour):
    INPUT_PORTS: ClassVar = {"speed": Port(float, default=0.5)}

    def update(self) -> py_trees.common.Status:
        return py_trees.common.Status.RUNNING


def running() -> Tree:
    body = "<Sequence><SubTree ID='Part' name='a'/><SubTree ID='Part' name='b'/></Sequence>"
    parts = "<Sequence><Go name='go' _bts_id='n1' speed='0.1'/><Go name='go' _bts_id='n2'/></Sequence>"
    return Tree.from_xml(document(body, subtree("Part", parts)), {"Go": Go})


def change(
    tree: Tree, path: str, value: str | None, node_id: str = "n1"
) -> tuple[Error | None, list[PortSet]]:
    said: list[PortSet] = []
    error = set_port(tree, SetPort(node_id=node_id, path=path, port="speed", value=value), said.append)
    return error, said


def test_the_path_names_the_instance_and_the_id_the_node() -> None:
    tree = running()
    error, said = change(tree, "b/go", "0.9")
    assert error is None
    assert said == [PortSet("n1", "Part", "b/go", "speed", "0.9", "0.1", "next_tick")]
    assert [node.get("speed") for node in tree.nodes if node.type == "Go"] == [0.1, 0.5, 0.9, 0.5]


def test_the_saved_text_stays_that_of_the_document() -> None:
    tree = running()
    change(tree, "a/go", "0.9")
    assert [said.saved for _, [said] in (change(tree, "a/go", "0.1"), change(tree, "a/go", None, "n2"))] == [
        "0.1",
        None,
    ]


def test_a_node_that_does_not_run_is_refused() -> None:
    error, said = change(running(), "c/go", "0.9")
    assert error is not None
    assert (error.code, said) == ("unknown_node", [])


def test_a_wrong_text_is_refused_with_its_place() -> None:
    error, said = change(running(), "a/go", "fast")
    assert error is not None
    assert (error.code, error.message, said) == (
        "bad_port",
        "'a/go': the port 'speed' takes a number: 'fast' is not a number.",
        [],
    )
