"""Names and texts of C++ made of any text."""

from __future__ import annotations

import ast
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from translator.cpp.names import (
    class_name,
    comment_lines,
    file_name,
    identifier,
    literal,
    macros,
    one_line,
    unique,
)

NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(?:_[A-Za-z0-9]+)*_?")


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("CheckObstacle", "CheckObstacle"),
        ("switch", "switch_"),
        ("NULL", "NULL_"),
        ("ETIMEDOUT", "ETIMEDOUT_"),
        ("M_PI", "M_PI_"),
        ("std", "std_"),
        ("Café", "Cafe"),
        ("Größe", "Grou00dfe"),
        ("a-b", "a_b"),
        ("__init__", "init"),
        ("_Upper", "Upper"),
        ("a__b", "a_b"),
        ("1st", "n1st"),
        ("", "unnamed"),
        ('"; }', "unnamed"),
    ],
)
def test_an_identifier_resembles_its_text(text: str, name: str) -> None:
    assert identifier(text) == name


@given(st.text())
def test_any_text_gives_a_valid_identifier(text: str) -> None:
    assert NAME.fullmatch(identifier(text))
    assert not re.search("__", class_name(text))


def test_macros_are_known() -> None:
    assert {"INT_MAX", "linux", "assert"} <= macros()
    assert identifier("EAST") == "EAST"


def test_a_class_does_not_hide_members_of_nodes() -> None:
    assert class_name("tick") == "tick_"
    assert class_name("getInput") == "getInput_"


def test_names_that_become_equal_get_numbers() -> None:
    taken: set[str] = set()
    assert [unique(identifier(text), taken) for text in ("Cafe", "Café", "if", "if")] == [
        *("Cafe", "Cafe_2", "if_", "if_2"),
    ]


@pytest.mark.parametrize(
    ("name", "file"),
    [("CheckObstacle", "check_obstacle"), ("ROSNode", "ros_node"), ("Go2D", "go2_d"), ("a_b", "a_b")],
)
def test_files_are_named_in_lower_case(name: str, file: str) -> None:
    assert file_name(name) == file


@given(st.text())
def test_a_literal_is_one_line_that_means_the_text(text: str) -> None:
    written = literal(text)
    assert "\n" not in written
    assert "??" not in written
    assert all(each.isprintable() for each in written)
    # Python reads octal escapes as C++ does, but of characters where C++ has bytes.
    value = ast.literal_eval(f"b{ascii_bytes(written)}")
    assert value.decode() == "".join("\ufffd" if is_forbidden(each) else each for each in text)


def is_forbidden(each: str) -> bool:
    return (each < " " and each not in "\t\n\r") or "\ud800" <= each <= "\udfff" or each in "\ufffe\uffff"


def ascii_bytes(written: str) -> str:
    plain = written.replace("\\?", "?")
    return "".join(
        each if each.isascii() else "".join(f"\\x{b:02x}" for b in each.encode()) for each in plain
    )


def test_digits_after_an_escape_stay_digits() -> None:
    assert literal("\t1") == '"\\0111"'


@given(st.text(alphabet=st.sampled_from("*/ \\a\n\u202e")))
def test_a_comment_cannot_be_ended(text: str) -> None:
    lines = list(comment_lines(text))
    assert not any("*/" in line or "/*" in line or "\u202e" in line for line in lines)
    assert "\n" not in one_line([text])
    assert not one_line([text]).endswith("\\")
