"""Deliberate differences from BehaviorTree.CPP are recognised in a run."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path

import pytest

from tree_gardener.blackboard import Blackboard
from tree_gardener.conformance import read_deviations, report, run_file
from tree_gardener.conformance.deviations import DEVIATIONS, KINDS, WatchedBlackboard


def test_a_remap_to_a_global_is_recorded() -> None:
    root = WatchedBlackboard()
    inner = WatchedBlackboard(root)
    inner.remapping["x"] = "@g"
    inner.create("y", None)
    assert root.deviations == set()
    inner.create("x", None)
    assert root.deviations == inner.deviations == {"global-through-remap"}
    assert isinstance(inner, Blackboard)


ENGINE_PAGE = Path(__file__).parents[3] / "docs/explanation/engine.md"
OWN = {"mine": {"kind": "more here", "reason": "a reason of your own", "cases": ["wrong *"]}}
XML = '<root BTCPP_format="4"><BehaviorTree ID="M"><AlwaysSuccess/></BehaviorTree></root>'


def test_each_kind_is_one_of_four_and_the_page_lists_every_deviation() -> None:
    page = ENGINE_PAGE.read_text(encoding="utf-8")
    for name, deviation in DEVIATIONS.items():
        assert deviation.kind in KINDS
        assert f"| `{name}` | {deviation.kind} | " in page


def test_a_file_of_your_own_names_reasons_for_cases(tmp_path: Path) -> None:
    (tmp_path / "own.json").write_text(json.dumps(OWN))
    cases = [{"name": name, "xml": XML, "rejected_410": True} for name in ("wrong one", "other")]
    (tmp_path / "cases.jsonl").write_text("\n".join(map(json.dumps, cases)))
    own = read_deviations(tmp_path / "own.json")
    outcomes = list(run_file(tmp_path / "cases.jsonl", own))
    assert [outcome.deviation for outcome in outcomes] == ["mine", ""]
    assert [outcome.failed for outcome in outcomes] == [False, True]
    assert list(report(Counter(["mine"]), own)) == [
        "1 differ on purpose, mine (more here): a reason of your own"
    ]


@pytest.mark.parametrize(
    "rows",
    [[], {"a": 1}, {"a": {"kind": "x", "reason": "", "cases": []}}, {"a": {**OWN["mine"], "cases": "b"}}],
)
def test_a_file_of_another_form_is_refused(tmp_path: Path, rows: object) -> None:
    (tmp_path / "own.json").write_text(json.dumps(rows))
    with pytest.raises(ValueError, match="deviation"):
        read_deviations(tmp_path / "own.json")
