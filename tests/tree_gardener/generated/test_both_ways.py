"""Generated code does the same as the nodes' own methods, at every call of a leaf and after every tick."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.budget import seeds
from tests.tree_gardener.generated.both_ways import RARE, USUAL, Run, cases, compare, loadable
from tree_gardener.conformance import run_file
from tree_gardener.generated import code, generation
from tree_gardener.generated.writer import Writer

CASES = Path(__file__).parents[2] / "conformance"


@pytest.mark.timeout(7200)
@pytest.mark.parametrize("letters", [USUAL, RARE])
@pytest.mark.parametrize("changes", [False, True])
def test_random_trees_show_the_same(letters: str, *, changes: bool) -> None:
    seen = inlined = 0
    today = seeds("engine_both_ways_trees")
    for case in loadable(today):
        entries, functions = compare(case, letters, changes=changes)
        seen += entries
        inlined += functions
    # Trees without code, or leaves that are never called, would prove nothing.
    assert inlined >= len(today)
    assert seen >= 20 * len(today)


@pytest.mark.parametrize(
    "name",
    ["added.jsonl", "focused.jsonl", "random.jsonl", "script_table.json", "throws.jsonl", "timed.jsonl"],
)
def test_the_corpus_passes_without_generated_code_too(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(generation, "ENABLED", False)
    assert [outcome for outcome in run_file(CASES / name) if not outcome.passed] == []


def test_a_difference_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Writer, "before", lambda writer, part: [])  # pre-conditions are forgotten
    code._codes.clear()
    try:
        with pytest.raises(AssertionError, match="generated"):
            _compare_all(200)
    finally:
        code._codes.clear()


def _compare_all(number: int) -> None:
    for case in cases(1, number):
        compare(case)


def test_a_run_records_the_state_of_all_nodes() -> None:
    case = cases(1, 3)[0]
    run = Run(case, is_generated=True, letters=USUAL, changes=False)
    seen = run.run()
    states = [entry[2] for entry in seen if isinstance(entry, tuple) and entry[0] == "update"]
    assert states
    assert {len(state) for state in states} == {len(run.state())}
    assert len(run.state()) > len(run.tree.nodes)
