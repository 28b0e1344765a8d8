"""The page on sealed runs has the rows of the tests of sealed processes, and a column a launcher."""

from __future__ import annotations

from pathlib import Path

from tests.executor.evaluation.sealed.test_confine import CELLS

ROOT = Path(__file__).parents[2]


def test_the_page_has_these_rows_and_a_column_a_launcher():
    text = (ROOT / "docs" / "explanation" / "sealed-runs.md").read_text()
    lines = text.partition("## What a sealed tree cannot do")[2].strip().splitlines()
    table = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("|")]
    head, rule, *rows = table[: 2 + len(CELLS)]
    assert head == ["it cannot", "process as root", "process as user", "Docker", "Kubernetes"]
    assert set(rule) == {"---"}
    assert [row[0] for row in rows] == list(CELLS)
    assert all(len(row) == len(head) and all(row) for row in rows)
