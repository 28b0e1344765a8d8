"""Which names projects and files may have."""

from __future__ import annotations

import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.config.problems import InvalidInputError
from backend.projects import names


@pytest.mark.parametrize(
    "path",
    [
        "project.json",
        "actions/Forward.py",
        "assets/карта.png",
        "a b/c d.txt",
        ".env",
        "x/.hidden",
        "日本/語.md",
        "می‌خواهم.py",
    ],
)
def test_good_paths(path):
    assert names.file_path(path) == unicodedata.normalize("NFC", path)


@pytest.mark.parametrize(
    "path",
    [
        "",
        "/etc/passwd",
        "../x",
        "a/../b",
        "a//b",
        "a/./b",
        "a/",
        "C:/x",
        "C:\\x",
        "a\\b",
        "a\0b",
        "a\nb",
        "con",
        "CON.txt",
        "a/nul",
        "ＣＯＮ",
        "lpt1.py",
        "a.",
        "a ",
        " a",
        "a/ b",
        "x\u202ey",
        "\ufeffx",
        "\ud800",
        "a" * 201,
        "a/" * 20 + "b",
        "x" * 401,
        "a*b",
        "a?b",
        'a"b',
        "<x>",
        "a|b",
        "COM1 .txt",
    ],
)
def test_bad_paths(path):
    with pytest.raises(InvalidInputError) as caught:
        names.file_path(path)
    assert caught.value.field == "path"
    caught.value.detail.encode()


@given(st.text())
def test_an_accepted_path_stays_below_its_folder_and_is_stable(text):
    try:
        path = names.file_path(text)
    except InvalidInputError:
        return
    assert names.file_path(path) == path
    assert not path.startswith("/")
    assert ".." not in path.split("/")
    assert "\\" not in path
    path.encode()


@pytest.mark.parametrize("name", ["Robot", "Роботы", "a.b", "x (2)", "🤖"])
def test_good_names(name):
    assert names.project_name(f"  {name} ") == name


@pytest.mark.parametrize("name", ["", "  ", ".", "..", "a/b", "a\\b", "a\nb", "\u202e", "x" * 101, "a\0"])
def test_bad_names(name):
    with pytest.raises(InvalidInputError):
        names.project_name(name)


@pytest.mark.parametrize(
    ("one", "other"), [("Straße", "STRASSE"), ("é", "e\u0301"), ("ﬁle", "FILE"), ("A", "a")]
)
def test_names_that_a_disk_may_confuse_have_one_key(one, other):
    assert names.key(one) == names.key(other)


def test_a_free_name_counts_up_and_keeps_its_length():
    assert names.free_name("Robot", set()) == "Robot"
    assert names.free_name("Robot", {"robot", "robot 2"}) == "Robot 3"
    long = "x" * names.MAX_NAME_LENGTH
    free = names.free_name(long, {names.key(long)})
    assert len(free) <= names.MAX_NAME_LENGTH
    assert free.endswith(" 2")
