"""Tuning: ratings, the comparison on fresh seeds, and what is said of it."""

import json
from pathlib import Path

import pytest

from executor.evaluation.outcome import Outcome
from executor.evaluation.plan import make_plan
from executor.evaluation.tuning.space import Port, TuningError
from executor.evaluation.tuning.study import Trial
from executor.evaluation.tuning.tune import Candidate, Objective, Tuned, study_key, tune, tuning_data, verdict
from tests.executor.evaluation.projects import project

SHARED = Path(__file__).parents[3] / "shared"
TEXT = "duration_s: 1\nruns: 2\nseed: {}\njudge: {{success: [{{never: collision}}]}}\n"
PORT = Port("MainTree.go.speed", "MainTree", "a", "speed", 0.1, 0.6)


def outcomes(successes, runs=40, start=1_000_000):
    return tuple(
        Outcome(
            start + n, "success" if n < successes else "failure", measures={"path_length_m": float(n % 7)}
        )
        for n in range(runs)
    )


def tuned(before, after, objective=Objective()):  # noqa: B008 - a constant
    now, new = outcomes(before), outcomes(after)
    trial = Trial(2, {PORT.address: 0.4}, objective.rate(new))
    best = Candidate(trial, new, objective.rate(new), objective.difference(now, new))
    return Tuned((PORT,), objective, (trial,), Candidate(None, now, objective.rate(now)), (best,))


def test_ratings_are_rates_or_means_of_what_counts():
    some = [*outcomes(3, 4), Outcome(9, "invalid")]
    assert Objective().rate(some) == 0.75
    assert Objective("path_length_m").rate(some) == 1.5
    assert Objective("energy_j").rate(some) is None
    assert Objective().rate([Outcome(9, "lost")]) is None


def test_an_improvement_is_an_interval_without_zero_on_the_better_side():
    assert tuned(10, 35).is_improvement
    assert verdict(tuned(10, 35)).startswith("the best values change success by +62.5%")
    for before, after in ((20, 21), (35, 10)):
        found = tuned(before, after)
        assert not found.is_improvement
        assert verdict(found).startswith("no improvement shown: success changes by")


def test_less_is_better_when_it_is_minimised():
    objective = Objective("path_length_m", maximise=False)
    now = outcomes(10)
    shorter = tuple(Outcome(each.seed, "success", measures={"path_length_m": -5.0}) for each in now)
    trial = Trial(0, {PORT.address: 0.4}, -5.0)
    best = Candidate(trial, shorter, -5.0, objective.difference(now, shorter))
    found = Tuned((PORT,), objective, (trial,), Candidate(None, now, objective.rate(now)), (best,))
    assert found.is_improvement
    assert best.difference.high < 0


def test_the_page_has_the_trials_and_both_sides():
    plan = make_plan(project(TEXT.format(0)), "main")
    data = tuning_data(tuned(10, 35), plan)
    assert data["today"]["rate"] == 0.25
    assert data["best"][0]["values"] == {PORT.address: 0.4}
    assert data["best"][0]["texts"] == {PORT.address: "0.4"}
    assert data["best"][0]["low"] < 0.875 < data["best"][0]["high"]
    assert data["trials"] == [{"number": 2, "values": {PORT.address: 0.4}, "rating": 0.875}]


def test_the_panel_reads_what_is_written():
    """Its tests read the same file."""
    plan = make_plan(project(TEXT.format(0)), "main")
    assert tuning_data(tuned(10, 35), plan) == json.loads((SHARED / "study.json").read_text())


def test_a_study_is_of_one_project_port_and_objective():
    plan = make_plan(project(TEXT.format(0)), "main")
    keys = {
        study_key(plan, [PORT], Objective(), runs=2, seed=0),
        study_key(plan, [PORT], Objective(), runs=3, seed=0),
        study_key(plan, [PORT], Objective("path_length_m"), runs=2, seed=0),
        study_key(plan, [], Objective(), runs=2, seed=0),
        study_key(make_plan(project(TEXT.format(1)), "main"), [PORT], Objective(), runs=2, seed=0),
    }
    assert len(keys) == 5


def test_trials_and_fresh_seeds_never_meet(tmp_path):
    plan = make_plan(project(TEXT.format(999_999)), "main")
    with pytest.raises(TuningError, match="have to be below 1000000"):
        tune(plan, [PORT], Objective(), tmp_path, trials=1, runs=2, fresh_runs=2)
