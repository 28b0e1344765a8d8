"""The check of the list of words finds its words, and only in prose of ours."""

from __future__ import annotations

import pytest

from tests.tools import words

LIST = words.read_list()


def found(kind: str, source: str) -> list[str]:
    return [finding.word for finding in words.find(words.READERS[kind](source), LIST)]


@pytest.mark.parametrize(
    ("kind", "source", "expected"),
    [
        (".py", '"""The tree is built anew."""', ["anew"]),
        (".py", "# Whoever\n# reads this.", ["Whoever"]),
        (".py", 'raise ValueError("the run goes\\non after that")', ["goes on"]),
        (".py", "def test_a_viewer_is_told_why(): ...", ["is told"]),
        (".py", 'def stop():\n    """Has the child end."""', ["Has …"]),
        (".py", '"""What an observer gets."""', ["What …"]),
        (".ts", "// mends the tree\nconst anew = 1;", ["mends"]),
        (".ts", "it('goes on after a pause', () => {});", ["goes on"]),
        (".json", '{"anew": "Build it anew"}', ["anew"]),
        (".md", "It stands\nstill.", ["stands still"]),
        (".sh", "echo anew # build it anew", ["anew"]),
    ],
)
def test_a_word_is_found_in_prose(kind, source, expected):
    assert found(kind, source) == expected


@pytest.mark.parametrize(
    ("kind", "source"),
    [
        (".py", '"""The word `anew`, and “whoever” in a quotation."""'),
        (".py", "anew = whoever()"),
        (".py", 'xml = "<Act besides=\\"goes on and on\\"/>"'),
        (".md", "> He goes on.\n\n```\nanew\n```\n"),
        (".ts", "const url = 'https://example.org/anew';"),
        (".ts", "const besides = mend(whoever);"),
        (".json", '{"besides": "also"}'),
    ],
)
def test_code_and_quotations_are_not_prose(kind, source):
    assert found(kind, source) == []


def test_the_place_is_the_line_of_the_word():
    source = '"""One line.\n\nThe next is built anew.\n"""\n'
    assert [finding.line for finding in words.find(words.python_texts(source), LIST)] == [3]


def test_every_clean_file_or_folder_exists():
    assert list(words.files(LIST.clean, LIST))


def test_names_of_behaviour_tests_are_prose_and_other_values_of_yaml_are_not(tmp_path):
    for name, read in (("a.test.yaml", words.markdown_texts), ("a.yaml", words.hash_texts)):
        assert words.reader(tmp_path / name) is read
