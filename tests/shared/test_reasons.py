"""The sentences that the page translates are those of the executor and the back end.

The page's side is `frontend/src/model/evaluation/reasons.test.ts`.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from executor.evaluation.document import Judge
from executor.evaluation.judge import make_items

ROOT = Path(__file__).resolve().parents[2]
SENTENCES = json.loads((ROOT / "tests/shared/reasons.json").read_text())["sentences"]
AREA = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0))
ITEMS = [
    {"never": "collision"},
    {"never": {"closer_than_m": 0.15, "to": "actors"}},
    {"reach": {"area": "door"}},
    {"visit": ["kitchen", "hall"], "in_order": True},
    {"visit": ["kitchen", "hall"]},
    {"tree": "SUCCESS"},
    {"python": "judge.py:quality", "at_least": {"share": 0.5}},
]


@pytest.mark.parametrize("row", [row for row in SENTENCES if "file" in row], ids=lambda row: row["key"])
def test_each_sentence_is_written_where_the_list_says(row):
    assert row["literal"] in (ROOT / row["file"]).read_text()
    for piece in row["literal"].replace("}", "{").split("{")[::2]:
        assert piece in row["sentence"]


def test_the_names_of_all_items_of_a_judge_are_in_the_list():
    judge = Judge.model_validate({"success": ITEMS})
    areas = dict.fromkeys(("door", "kitchen", "hall"), AREA)
    items = make_items(judge, areas, lambda _: lambda: None, lambda _: lambda _: {})
    assert sorted(item.name for item in items) == sorted(
        row["sentence"] for row in SENTENCES if "file" not in row
    )
