"""The stored operations, with which the page's comparison is tested, are those of the translator."""

from __future__ import annotations

from tests.shared.make_differences import FILE, cases, text, under_new_ids
from translator.difference import compare


def test_the_cases_are_up_to_date():
    assert FILE.read_text(encoding="utf-8") == text(), "run python -m tests.shared.make_differences"


def test_each_kind_of_operation_is_among_them():
    found = {operation["op"] for older, newer in cases().values() for operation in compare(older, newer)}
    assert found == {"insert", "delete", "wrap", "unwrap", "move", "reorder", "rename", "change"}


def test_other_ids_alone_are_no_difference():
    older, _ = cases()["equal"]
    assert compare(older, under_new_ids(older, "x")) == []
