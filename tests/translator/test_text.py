"""Text that all formats can hold."""

from __future__ import annotations

import pytest

from translator.text import bad_character, clean, is_clean, is_valid_id, is_xml_name, safe_name


def test_what_xml_cannot_hold_is_replaced() -> None:
    assert is_clean("tab\tand line\n")
    assert not is_clean("bell\x07")
    assert clean("bell\x07 \ud800") == "bell\ufffd \ufffd"


@pytest.mark.parametrize(("text", "bad"), [("Tree", None), ("My Tree", " "), ("a.b", "."), ("a<", "<")])
def test_the_first_character_that_no_id_may_have(text: str, bad: str | None) -> None:
    assert bad_character(text) == bad


def test_an_id_is_not_empty_and_not_root() -> None:
    assert is_valid_id("Tree_1")
    assert not any(map(is_valid_id, ("", "root", "Root", "a/b")))


def test_names_of_files_differ_where_ids_differ() -> None:
    assert safe_name("a/b") != safe_name("a:b")
    assert safe_name("a/b").startswith("a_b_")
    assert safe_name("///").startswith("tree_")


def test_names_of_xml_are_those_that_a_parser_reads() -> None:
    assert all(map(is_xml_name, ("speed", "_x", "größe")))
    assert not any(map(is_xml_name, ("1st", "a b", "a:b", "", "<")))
