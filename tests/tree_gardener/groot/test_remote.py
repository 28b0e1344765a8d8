"""Documents and messages of any content are read or refused with a sentence."""

from __future__ import annotations

import contextlib
import struct
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from tests.tree_gardener.groot.cpp_program import XML
from tree_gardener import Tree
from tree_gardener.groot import GrootError
from tree_gardener.groot.document import document_of
from tree_gardener.groot.remote import LAST_STATUS, read_boards, read_statuses, read_transitions, read_tree

DOCUMENT = document_of(Tree.from_xml(XML))


@given(st.integers(0, len(DOCUMENT) - 1), st.binary(max_size=8), st.integers(0, 40))
def test_a_changed_document_is_read_or_refused(place: int, piece: bytes, removed: int) -> None:
    changed = DOCUMENT[:place] + piece + DOCUMENT[place + removed :]
    with contextlib.suppress(GrootError):
        assert read_tree(bytes(16), changed).nodes


@given(st.binary(max_size=300))
def test_statuses_of_any_bytes_are_read_or_counted(data: bytes) -> None:
    states, dropped = read_statuses(data)
    assert len(states) + dropped <= -(-len(data) // 3)
    assert (len(states) + dropped > 0) == (len(data) > 0)


anything = st.recursive(
    st.none() | st.integers() | st.text() | st.binary(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text() | st.integers(), inner),
)


@given(anything)
def test_boards_have_texts_for_names(document: Any) -> None:
    for name, entries in read_boards(document).items():
        assert isinstance(name, str)
        assert all(isinstance(key, str) for key in entries)


@given(st.binary(max_size=300))
def test_transitions_of_any_bytes_are_read_or_counted(data: bytes) -> None:
    found, dropped = read_transitions(data)
    known = [row for row in found if row[3] <= LAST_STATUS]
    assert len(known) + dropped == -(-len(data) // 9)


def test_a_transition_has_a_time_of_six_bytes() -> None:
    data = (5 << 32 | 7).to_bytes(6, "little") + struct.pack("<HB", 513, 2)
    found, dropped = read_transitions(data + bytes(8) + b"\x05" + b"rest")
    assert (list(found), dropped) == ([(7, 5, 513, 2), (0, 0, 0, 5)], 2)


def test_each_node_has_the_one_above_it() -> None:
    tree = read_tree(bytes(16), DOCUMENT)
    assert [(node.uid, node.parent) for node in tree.nodes][:6] == [
        (1, 0),
        (2, 1),
        (3, 1),
        (4, 3),
        (5, 4),
        (6, 1),
    ]
