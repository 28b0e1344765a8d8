"""The folder of results."""

import json

import pytest

from executor.evaluation.outcome import Outcome
from executor.evaluation.plan import make_plan
from executor.evaluation.report import world_of
from executor.evaluation.results import PART, RUNS, Results, ResultsError, inputs_of, kept_outcomes
from tests.executor.evaluation.projects import project

GOOD = "duration_s: 5\nruns: 2\njudge: {success: [{never: collision}]}\n"
MINE = {"id": "a", "numpy": "2"}


def begun(tmp_path, plan, outcomes=(), prints=(MINE,)):
    results = Results(tmp_path)
    results.begin({"inputs": inputs_of(plan), "fingerprints": list(prints)}, outcomes)
    return results


def test_each_outcome_is_kept_at_once_and_the_end_is_ordered(tmp_path):
    plan = make_plan(project(GOOD), "main")
    results = begun(tmp_path, plan, [Outcome(5, "success")])
    results.add(Outcome(9, "failure"))
    results.add(Outcome(2, "success"))
    assert [outcome.seed for outcome in Results(tmp_path).outcomes()] == [2, 5, 9]
    results.finish(results.outcomes())
    assert not (tmp_path / PART).exists()
    assert [json.loads(line)["seed"] for line in (tmp_path / RUNS).read_text().splitlines()] == [2, 5, 9]


def test_a_line_that_was_cut_off_is_run_again_and_a_wrong_one_is_named(tmp_path):
    plan = make_plan(project(GOOD), "main")
    results = begun(tmp_path, plan)
    results.add(Outcome(1, "success"))
    with (tmp_path / PART).open("ab") as file:
        file.write(b'{"seed": 2, "outc')
    assert [outcome.seed for outcome in results.outcomes()] == [1]
    (tmp_path / RUNS).write_text("nonsense\n")
    with pytest.raises(ResultsError, match=r"runs\.jsonl:1:1"):
        results.outcomes()


def test_results_are_continued_only_for_the_same_inputs(tmp_path):
    plan = make_plan(project(GOOD), "main")
    results = begun(tmp_path, plan, [Outcome(1, "success"), Outcome(2, "lost")])
    kept, prints, notes = kept_outcomes(results, plan, MINE)
    assert ([outcome.seed for outcome in kept], prints, notes) == ([1], [MINE], [])
    other = {"id": "b", "numpy": "3"}
    kept, prints, notes = kept_outcomes(results, plan, other)
    assert prints == [MINE, other]
    assert notes == ["the results were made on another platform: numpy: 2 then, 3 now"]
    changed = make_plan(project(GOOD + "# changed\n"), "main")
    assert inputs_of(changed) != inputs_of(plan)
    with pytest.raises(ResultsError, match="another version"):
        kept_outcomes(results, changed, MINE)


def test_a_folder_without_results_says_so(tmp_path):
    with pytest.raises(ResultsError, match="no results"):
        Results(tmp_path).header()
    (tmp_path / "evaluation.json").write_text("[]")
    with pytest.raises(ResultsError, match="no results"):
        Results(tmp_path).header()
    (tmp_path / "file").write_text("")
    with pytest.raises(ResultsError, match="cannot be written"):
        Results(tmp_path / "file" / "in").begin({})


def test_results_of_another_version_of_the_universe_are_not_continued(tmp_path):
    plan = make_plan(project(GOOD), "main")
    results = Results(tmp_path)
    for version in (world_of(plan.universe)["version"], "00000000"):
        results.begin({"inputs": inputs_of(plan), "universe": version, "fingerprints": [MINE]})
        if version == "00000000":
            with pytest.raises(ResultsError, match="version 00000000 of the world “Yard”"):
                kept_outcomes(results, plan, MINE)
        else:
            assert kept_outcomes(results, plan, MINE)[0] == []
