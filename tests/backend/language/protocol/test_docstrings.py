"""Docstrings as the editor's cards show them."""

from __future__ import annotations

import pytest

from backend.language.protocol.docstrings import LIMIT, readable
from backend.language.protocol.messages import for_page

NBSP = "&nbsp;"


@pytest.mark.parametrize(
    ("written", "shown"),
    [
        ("A :class:`~py_trees.common.Status` of it.", "A `Status` of it."),
        ("See :py:meth:`setup` and :obj:`!x`.", "See `setup` and `x`."),
        ("[:class:`~a.B`]: see :ref:`the page <some-label>`", "[`B`]: see `the page`"),
        ("``double`` and `one`, at 10:30: `x`", "``double`` and `one`, at 10:30: `x`"),
        (r"~py\_trees.behaviours.Behaviour.feedback\_message(:obj:`str`)", r"feedback\_message(`str`)"),
        ("in ~/.bashrc and ~user", "in ~/.bashrc and ~user"),
        (f"Note:  \n{NBSP * 4}Hey.", f"**Note:**  \n{NBSP * 4}Hey."),
        ("It says:  \nnothing.", "It says:  \nnothing."),
        ("## Returns\n`bool`", "## Returns\n`bool`"),
        ("```python\n    f(1)\n\n      g(2)\n\n```", "```python\nf(1)\n\n  g(2)\n```"),
        ("```python\n:ref:`x`\n```", "```python\n:ref:`x`\n```"),
        ("```python\n   * :ref:`A <a>`\n   * b\n```", "\n* `A`\n* b\n"),
        ("````\n```\n    x\n````", "````\n```\n    x\n````"),
        ("```\nnever closed :ref:`x`", "```\nnever closed :ref:`x`"),
        ("", ""),
    ],
)
def test_a_docstring_is_read_by_people(written: str, shown: str) -> None:
    assert readable(written) == shown


def test_a_long_docstring_ends_with_a_whole_line() -> None:
    shown = readable("one line\n" * 100_000)
    assert len(shown) <= LIMIT
    assert shown.endswith("one line\n\n…")
    assert len(readable("x" * 1_000_000)) <= LIMIT + 3


@pytest.mark.parametrize("mark", ["> ", ">", "- ", "1. ", "* "])
def test_the_pages_parser_gets_no_deep_nesting(mark: str) -> None:
    shown = readable(mark * 2000 + "x")
    assert shown.startswith(mark * 4 + "\\" + mark)


def test_a_deep_indentation_leaves_room_for_words() -> None:
    assert readable(NBSP * 800 + "deep") == NBSP * 16 + "deep"


@pytest.mark.parametrize("mark", ["`", ":a", ":`", "~a.", "~a", "<", "[", "&nbsp;", " ", "\n```", "A"])
def test_hostile_text_is_read_in_a_moment(mark: str) -> None:
    assert len(readable(mark * 100_000)) <= LIMIT + 3


def test_cards_popups_and_signatures_are_readable() -> None:
    text = "See :class:`~a.B`."
    for result in (
        {"contents": {"kind": "markdown", "value": text}},
        {"items": [{"documentation": {"kind": "markdown", "value": text}}]},
        {"items": [{"documentation": text}]},
        {"signatures": [{"documentation": {"value": text}, "parameters": [{"documentation": text}]}]},
    ):
        shown, _ = for_page({"id": 1, "result": result})
        assert "~a" not in str(shown)
        assert "`B`" in str(shown)


def test_a_finding_is_not_changed() -> None:
    finding = {"message": "unknown :class:`~a.B`"}
    params = {"uri": "u", "diagnostics": [finding]}
    shown, _ = for_page({"method": "textDocument/publishDiagnostics", "params": params})
    assert shown is not None
    assert shown["params"]["diagnostics"] == [finding]
