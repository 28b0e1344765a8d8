"""Trees of logs."""

from __future__ import annotations

import pytest

from executor.recorder.outside.errors import OutsideError
from executor.recorder.outside.tree_xml import MOST_XML_BYTES, flat_tree, tree_of_xml
from tests.executor.recorder.outside.logs import XML


def tree(text):
    return tree_of_xml(text.encode(), "f", 7)


def root(inside):
    return f'<root BTCPP_format="4">{inside}</root>'


def test_subtrees_are_opened_by_their_paths():
    found = tree(XML)
    assert found.columns["parent"] == [0, 1, 1, 3, 4]
    assert found.numbers == {1: 1, 2: 2, 3: 3, 4: 4, 5: 5}


def test_a_document_without_numbers_and_paths_is_read_by_ids():
    found = tree(
        root(
            '<BehaviorTree ID="Main"><Fallback><Action ID="Go" name="go"/><SubTree ID="Sub"/></Fallback>'
            '</BehaviorTree><BehaviorTree ID="Sub"><Way/></BehaviorTree>'
        )
    )
    assert found.columns["path"] == ["Fallback::1", "go", "Sub", "Sub/Way::4"]
    assert found.columns["type"] == ["Fallback", "Go", "SubTree", "Way"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (root('<BehaviorTree ID="A"><SubTree ID="A"/></BehaviorTree>'), "more than 20000 nodes"),
        (root('<BehaviorTree ID="A"><S _uid="1"><T _uid="1"/></S></BehaviorTree>'), "two nodes .* number 1"),
        (root('<BehaviorTree ID="A"><S _uid="-1"/></BehaviorTree>'), "the number '-1'"),
        (root('<BehaviorTree ID="A"/>'), "no tree"),
        (" " * (MOST_XML_BYTES + 1), "8388609 bytes"),
    ],
)
def test_hostile_documents_are_refused(text, message):
    with pytest.raises(OutsideError, match=message) as caught:
        tree(text)
    assert caught.value.offset == 7


def test_names_alone_make_a_flat_tree():
    found = flat_tree({1: "root", 5: "go", 9: "go"})
    assert (found.columns["parent"], found.columns["path"]) == ([0, 1, 1], ["root", "go::2", "go::3"])
    assert found.numbers == {1: 1, 5: 2, 9: 3}
