"""Documents that belong together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.trees import LEAVES, document, subtree
from tree_gardener import LoadError, Status, Tree
from tree_gardener.forest import Forest

if TYPE_CHECKING:
    from pathlib import Path


def test_including_and_registering_documents(tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    arm = subtree("Arm", '<SubTree ID="Hand"/>')
    (tmp_path / "sub" / "arm.xml").write_text(f"<root><include path='hand.xml'/>{arm}</root>")
    (tmp_path / "sub" / "hand.xml").write_text(f"<root>{subtree('Hand', '<Succeeding/>')}</root>")
    main = document(
        '<Sequence><SubTree ID="Arm"/><SubTree ID="Leg"/></Sequence>', "<include path='sub/arm.xml'/>"
    )
    (tmp_path / "main.xml").write_text(main)
    leg = f"<root>{subtree('Leg', '<Succeeding/>')}</root>"
    tree = Tree.from_file(tmp_path / "main.xml", LEAVES, documents=[leg])
    assert tree.tick_exactly_once() is Status.SUCCESS
    assert len(tree.nodes) == 6


@pytest.mark.parametrize(
    ("include", "message"),
    [
        ("<include path='no.xml'/>", "cannot be read"),
        ("<include path='main.xml'/>", "includes itself"),
        ("<include path='x.xml' ros_pkg='no_such_package'/>", "not installed"),
    ],
)
def test_an_include_that_fails_is_located(tmp_path: Path, include: str, message: str) -> None:
    path = tmp_path / "main.xml"
    path.write_text(f"<root>\n  {include}\n{subtree('Main', '<Succeeding/>')}</root>")
    with pytest.raises(LoadError, match=message) as refused:
        Tree.from_file(path, LEAVES)
    assert refused.value.diagnostics[0].line in (2, 1)
    with pytest.raises(LoadError, match=r"base_path|not installed"):
        Tree.from_xml(path.read_text(), LEAVES)


def test_the_main_tree_can_be_chosen() -> None:
    text = f"<root>{subtree('A', '<Succeeding/>')}{subtree('B', '<Failing/>')}</root>"
    assert Tree.from_xml(text, LEAVES, main_tree="B").tick_exactly_once() is Status.FAILURE
    with pytest.raises(LoadError, match="the trees are: A, B"):
        Tree.from_xml(text, LEAVES, main_tree="C")


def test_of_two_documents_the_last_one_is_the_main_one() -> None:
    forest = Forest()
    forest.read(f"<root>{subtree('A', '<Succeeding/>')}</root>", "a.xml", None)
    forest.read(f"<root>{subtree('B', '<Succeeding/>')}</root>", "b.xml", None)
    assert forest.main is not None
    assert forest.main.name == "b.xml"
    assert [document.name for document in forest.documents] == ["a.xml", "b.xml"]


def test_a_document_of_one_include_runs_the_tree_that_it_includes(tmp_path: Path) -> None:
    (tmp_path / "one.xml").write_text(f"<root>{subtree('One', '<Succeeding/>')}</root>")
    (tmp_path / "main.xml").write_text("<root><include path='one.xml'/></root>")
    assert Tree.from_file(tmp_path / "main.xml", LEAVES).nodes[0].tree_id == "One"
    (tmp_path / "one.xml").write_text(
        f"<root>{subtree('One', '<Succeeding/>')}{subtree('Two', '<Succeeding/>')}</root>"
    )
    with pytest.raises(LoadError) as refused:
        Tree.from_file(tmp_path / "main.xml", LEAVES)
    assert refused.value.diagnostics[0].code == "TG221"
