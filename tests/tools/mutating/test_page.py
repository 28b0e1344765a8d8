"""Mutants keep the syntax, are chosen by their seed, and leave imports and types alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.tools.mutating.page import chosen, mutants_of


def changes(line: str) -> list[str]:
    return [mutant.after for mutant in mutants_of(Path("a.ts"), line)]


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("if (a) return;", "if (!(a)) return;"),
        ("if (is(a, b)) {", "if (!(is(a, b))) {"),
        ("const x = a && b;", "const x = a || b;"),
        ("const isOpen = true;", "const isOpen = false;"),
        ("const x = y === 3;", "const x = y === (3 + 1);"),
        ("  store.close();", "  ;"),
        ("  return count;", "  return undefined as never;"),
    ],
)
def test_a_line_is_changed(line, expected):
    assert expected in changes(line)


@pytest.mark.parametrize(
    "line",
    [
        "import { a } from 'b';",
        "  // true",
        "type A = 1 | 2;",
        '<div className="true" />',
        'aria-hidden="true"',
        "} else {",
        "if (",
    ],
)
def test_lines_without_behaviour_are_left_alone(line):
    assert changes(line) == []


def test_the_seed_decides(tmp_path):
    (tmp_path / "one.ts").write_text("".join(f"const x{number} = a && b;\n" for number in range(20)))
    (tmp_path / "one.test.ts").write_text("const x = a && b;\n")
    first = chosen(tmp_path, 5, seed=1)
    assert first == chosen(tmp_path, 5, seed=1) != chosen(tmp_path, 5, seed=2)
    assert {mutant.path.name for mutant in first} == {"one.ts"}
    assert len({mutant.line for mutant in first}) == 5
