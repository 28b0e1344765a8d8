"""The study: seeded, kept in a file, and the same when it was interrupted."""

import sys

import pytest

from executor.evaluation.tuning.space import Port, TuningError
from executor.evaluation.tuning.study import FILE, Study, import_optuna, sampler_seed

PORTS = [Port("T.a.x", "T", "a", "x", 0.0, 1.0), Port("T.a.n", "T", "a", "n", 1, 5, whole=True)]


def rate(values):
    return None if values["T.a.n"] == 5 else -((values["T.a.x"] - 0.7) ** 2)


def study(folder, *, maximise=True, key="k"):
    return Study(folder, key, PORTS, maximise=maximise, seed=3)


def test_a_study_is_the_same_again_and_after_an_interruption(tmp_path):
    whole, parts = study(tmp_path / "whole"), study(tmp_path / "parts")
    whole.run(14, rate)

    def stops(values):
        if len(parts.trials) == 6:
            raise KeyboardInterrupt
        return rate(values)

    with pytest.raises(KeyboardInterrupt):
        parts.run(14, stops)
    assert len(parts.trials) == 6
    parts.close()
    again = study(tmp_path / "parts")
    again.run(14, rate)
    assert again.trials == whole.trials
    assert len(whole.trials) == 14
    assert any(each.rating is None for each in whole.trials) == any(
        each.values["T.a.n"] == 5 for each in whole.trials
    )
    assert all(isinstance(each.values["T.a.n"], int) for each in whole.trials)
    for each in (whole, again):
        each.close()


def test_the_best_trials_are_distinct_and_in_order(tmp_path):
    for maximise in (True, False):
        found = study(tmp_path / str(maximise), maximise=maximise)
        found.run(8, lambda values: round(values["T.a.x"], 1))
        best = found.best(3)
        ratings = [each.rating for each in best]
        assert ratings == sorted(ratings, reverse=maximise)
        assert len({tuple(each.values.items()) for each in best}) == 3
        others = [each.rating for each in found.trials if each not in best]
        assert all((ratings[-1] >= each) if maximise else (ratings[-1] <= each) for each in others)
        found.close()


def test_another_key_is_another_study(tmp_path):
    first = study(tmp_path)
    first.run(2, rate)
    second = study(tmp_path, key="other")
    assert second.trials == []
    for each in (first, second):
        each.close()


def test_each_trial_has_a_seed_of_its_own():
    assert len({sampler_seed(seed, number) for seed in range(3) for number in range(50)}) == 150


def test_a_missing_extra_is_one_sentence_with_the_command(monkeypatch):
    monkeypatch.setitem(sys.modules, "optuna", None)  # as if it were not installed
    with pytest.raises(TuningError, match=r"not installed: .* -m pip install 'optuna~=") as found:
        import_optuna()
    assert "\n" not in str(found.value)


@pytest.mark.parametrize("how", ["a file in place of the folder", "a file that is no study"])
def test_a_folder_that_can_hold_no_study_is_named(tmp_path, how):
    folder = tmp_path / "r"
    if how == "a file in place of the folder":
        folder.touch()
    else:
        folder.mkdir()
        (folder / FILE).write_text("no database, but some text that is longer than a few letters")
    with pytest.raises(TuningError, match=r"r/study\.sqlite: no study can be kept here"):
        study(folder)
