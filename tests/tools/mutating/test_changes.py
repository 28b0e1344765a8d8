"""Changes keep the syntax, and leave types, imports and documentation alone."""

from __future__ import annotations

import pytest

from tests.tools.mutating.changes import changed, changes_of


def lines_of(source: str) -> set[str]:
    mutants = [changed("a.py", source, change) for change in changes_of(source)]
    return {mutant.after for mutant in mutants if mutant}


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("if a(b):\n    c()\n", {"if (not (a(b))):", "pass"}),
        ("x = a and b\n", {"x = a or b"}),
        ("x = a < b\n", {"x = a >= b"}),
        (
            "x = 'é' in b - 1\n",
            {"x = 'é changed' in b - 1", "x = 'é' not in b - 1", "x = 'é' in b + 1", "x = 'é' in b - 2"},
        ),
        ("def f():\n    return g(3)\n", {"return None", "return g(4)"}),
        ("x = True\n", {"x = False"}),
        ("x: int | None = 2\n", {"x: int | None = 3"}),
        ("while a:\n    b.c()\n", {"while (not (a)):", "pass"}),
        ("x = a if b else c\n", {"x = a if (not (b)) else c"}),
        ("def f(a: int = 1) -> int:\n    return a\n", {"def f(a: int = 2) -> int:", "return None"}),
    ],
)
def test_a_line_is_changed(source, expected):
    assert lines_of(source) == expected


@pytest.mark.parametrize(
    "source",
    [
        "from a import b\n",
        '"""True."""\n',
        "def f(a: A | B) -> C | D:\n    raise E\n",
        "if TYPE_CHECKING:\n    import a\n",
        "__all__ = ['a']\n",
        "def f():\n    return None\n",
        "@a(1)\ndef f():\n    ...\n",
        "x = f'{a - b}'\n",
    ],
)
def test_lines_without_behaviour_are_left_alone(source):
    assert lines_of(source) == set()


def test_a_change_that_is_no_python_is_passed_over():
    source = "x = (a\n    + b)\n"
    assert lines_of(source) == {"- b)"}
    assert changed("a.py", source, changes_of(source)[0]._replace(new="if")) is None
