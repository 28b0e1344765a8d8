"""The stored repairs, to which the editor is held, are those of the translator."""

from __future__ import annotations

from tests.shared.make_repairs import FILE, cases, text


def test_the_repairs_are_up_to_date():
    assert FILE.read_text(encoding="utf-8") == text(), "run python -m tests.shared.make_repairs"


def test_each_node_is_kept_once():
    for case in cases():
        tops = [case["root"], *case["drafts"]] if case["root"] else case["drafts"]
        below = [child for children in case["children"].values() for child in children]
        assert sorted([*tops, *below]) == sorted(case["given"]["nodes"])
