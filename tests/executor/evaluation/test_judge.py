"""The judge on trajectories made by hand."""

import contextlib
import io

import numpy as np
import pytest

from executor.evaluation.document import Judge
from executor.evaluation.judge import FAILURE, SUCCESS, JudgeError, Referee, make_items
from executor.evaluation.truth import Bump, Sample, Truth
from tests.fakes.hostile_values import VALUES

AREAS = {
    "door": ((4.0, -1.0), (6.0, -1.0), (6.0, 1.0), (4.0, 1.0)),
    "hall": ((1.0, -1.0), (2.0, -1.0), (2.0, 1.0), (1.0, 1.0)),
}


class Track:
    """A robot that drives along x at 1 m/s, looked at once a second."""

    def __init__(self, success, *, duration_s=10.0, function=None):
        self.truth = Truth(AREAS)
        self.distance = {}
        judge = Judge.model_validate({"success": success})
        items = make_items(judge, AREAS, self.measure, lambda _: function)
        self.referee = Referee(items, duration_s)

    def measure(self, what):
        return lambda: self.distance.get(what)

    def run(self, xs, *, root=None, bump_at=None):
        decision = None
        for time_s, x in enumerate(xs):
            status = root[1] if root and time_s >= root[0] else "RUNNING"
            if bump_at == time_s:
                self.truth.bumps.append(Bump(time_s - 0.25, x, 0, "wall"))
            self.truth.samples.append(Sample(float(time_s), x, 0.0, 0.0, {}, status))
            decision = self.referee.look(self.truth)
            if decision is not None:
                break
        return decision

    def verdict(self, index=0):
        return self.referee.verdicts()[index]


def outcome(decision):
    return decision.outcome, decision.at_s


def test_reach_is_met_once_and_ends_the_run():
    track = Track([{"reach": {"area": "door", "within_s": 6}}])
    assert outcome(track.run([0, 1, 2, 3, 4.5, 9])) == (SUCCESS, 4)
    assert (track.verdict().margin, track.verdict().unit) == (2, "s")


def test_reach_fails_when_its_time_is_over_and_says_how_far_it_was():
    track = Track([{"reach": {"area": "door", "within_s": 3}}])
    decision = track.run([0, 1, 2, 3, 4.5])
    assert outcome(decision) == (FAILURE, 4)
    assert decision.why == "reach door: the time is over"
    assert (track.verdict().margin, track.verdict().unit) == (-1, "m")


def test_a_goal_stays_met_until_the_others_are():
    track = Track([{"reach": {"area": "hall"}}, {"reach": {"area": "door"}}])
    assert outcome(track.run([0, 1.5, 3, 4.5])) == (SUCCESS, 3)


def test_an_unmet_goal_fails_at_the_end_of_the_time():
    track = Track([{"reach": {"area": "door"}}], duration_s=3)
    assert outcome(track.run([0, 1, 2, 3, 4.5])) == (FAILURE, 3)


def test_never_collision():
    track = Track([{"never": "collision"}], duration_s=3)
    assert outcome(track.run([0, 1, 2, 3])) == (SUCCESS, 3)
    track = Track([{"never": "collision"}, {"reach": {"area": "door"}}])
    assert outcome(track.run([0, 1, 4.5], bump_at=2)) == (FAILURE, 1.75)  # in the same look as the goal
    assert (track.verdict().margin, track.verdict().unit) == (1.75 - 10, "s")


def test_never_closer():
    track = Track([{"never": {"closer_than_m": 0.15, "to": "actors"}}], duration_s=2)
    track.distance["actors"] = 0.2
    assert outcome(track.run([0, 1, 2])) == (SUCCESS, 2)
    assert track.verdict().margin == pytest.approx(0.05)
    track = Track([{"never": {"closer_than_m": 0.15, "to": "actors"}}], duration_s=2)
    track.distance["actors"] = 0.1
    assert outcome(track.run([0, 1, 2])) == (FAILURE, 0)
    assert track.verdict().margin == pytest.approx(-0.05)


def test_visit_in_any_order_and_in_order():
    way_back = [5, 3, 1.5, 0]
    assert outcome(Track([{"visit": ["hall", "door"]}]).run(way_back)) == (SUCCESS, 2)
    track = Track([{"visit": ["hall", "door"], "in_order": True}], duration_s=3)
    assert outcome(track.run(way_back)) == (FAILURE, 3)
    track = Track([{"visit": ["hall", "door"], "in_order": True}])
    assert outcome(track.run([5, 1.5, 3, 5])) == (SUCCESS, 3)
    track = Track([{"visit": ["hall"], "within_s": 1}])
    assert outcome(track.run([0, 0, 1.5])) == (FAILURE, 2)


def test_tree_counts_its_result_alone():
    assert outcome(Track([{"tree": "SUCCESS"}]).run([0, 1, 2], root=(1, "SUCCESS"))) == (SUCCESS, 1)
    track = Track([{"tree": "SUCCESS"}], duration_s=2)
    assert outcome(track.run([0, 1, 2], root=(1, "FAILURE"))) == (FAILURE, 2)


def test_a_function_decides_at_the_end():
    criterion = {"python": "judge.py:quality", "at_least": {"calm": 0.5}, "at_most": {"far": 3}}
    track = Track(
        [criterion], duration_s=2, function=lambda truth: {"calm": 0.75, "far": truth.samples[-1].x}
    )
    assert outcome(track.run([0, 1, 2])) == (SUCCESS, 2)
    assert track.verdict().margin == 0.25
    assert track.referee.numbers() == {"calm": 0.75, "far": 2}
    track = Track([criterion], duration_s=2, function=lambda _: {"calm": 0.25, "far": 0})
    assert outcome(track.run([0, 1, 2])) == (FAILURE, 2)


@pytest.mark.parametrize(
    ("returned", "words"),
    [
        (3, "returned int"),
        ({"calm": "yes"}, "no number"),
        ({"calm": float("nan")}, "not finite"),
        ({}, "no 'calm'"),
    ],
)
def test_a_function_that_returns_something_else_is_an_error(returned, words):
    track = Track(
        [{"python": "judge.py:quality", "at_least": {"calm": 0}}], duration_s=0, function=lambda _: returned
    )
    with pytest.raises(JudgeError, match=words):
        track.run([0])


def test_a_function_may_return_numbers_of_numpy():
    criterion = {"python": "judge.py:quality", "at_least": {"calm": 0}}
    track = Track([criterion], duration_s=0, function=lambda _: {"calm": np.float32(0.5), "n": np.int64(3)})
    assert outcome(track.run([0])) == (SUCCESS, 0)
    assert track.referee.numbers() == {"calm": 0.5, "n": 3.0}


def test_any_value_that_a_function_returns_is_judged_or_an_error():
    criterion = {"python": "judge.py:quality", "at_least": {"calm": 0}}
    for value in VALUES:
        for returned in (value, {"calm": value}, {"calm": 1, "other": value}):
            track = Track([criterion], duration_s=0, function=lambda _, returned=returned: returned)
            with contextlib.suppress(JudgeError), contextlib.redirect_stdout(io.StringIO()):
                track.run([0])
