"""Changes that belong to one tick."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from executor.recorder.outside.steps import Steps

MS = 1_000_000


def steps_of(changes):
    steps = Steps()
    found = [steps.take(*change) for change in changes]
    return [step for step in [*found, steps.end()] if step is not None]


def test_changes_that_follow_closely_are_one_step():
    found = steps_of([(0, 1, 1), (1000, 2, 2), (20 * MS, 2, 0), (20 * MS, 1, 2)])
    assert [(step.t_ns, step.duration_ns, step.changed) for step in found] == [
        (0, 1000, [(1, 1), (2, 2)]),
        (20 * MS, 0, [(2, 0), (1, 2)]),
    ]


def test_changes_at_once_make_the_steps_of_changes_one_by_one():
    changes = [(i * 400_000, i % 5, (2, 0, 1, 3)[i % 4]) for i in range(500)]
    one_by_one, at_once = Steps(), Steps()
    expected = [step for change in changes if (step := one_by_one.take(*change)) is not None]
    found = at_once.take_all(changes[:123]) + at_once.take_all(changes[123:])
    assert found == expected
    assert len(found) > 50
    assert at_once.end() == one_by_one.end()


def test_a_result_that_did_not_stay_flashes():
    (step,) = steps_of([(0, 1, 1), (1, 2, 3), (2, 2, 0), (3, 1, 3), (4, 1, 0)])
    assert (step.changed, step.flashed) == ([], [(2, 3), (1, 3)])


def test_a_node_that_begins_again_begins_a_step():
    found = steps_of([(0, 1, 2), (1, 1, 0), (2, 1, 3), (3, 1, 0)])
    assert [step.flashed for step in found] == [[(1, 2)], [(1, 3)]]


def test_a_long_burst_is_divided():
    assert len(steps_of([(n * MS // 2, 1 + n % 2, 1 - n // 2 % 2) for n in range(200)])) == 2


@given(st.lists(st.tuples(st.integers(0, 3 * MS), st.integers(1, 3), st.integers(0, 4))))
def test_no_result_is_lost(changes):
    t_ns, told = 0, []
    last: dict[int, int] = {}
    for gap_ns, uid, status in changes:
        if last.get(uid, 0) != status:
            t_ns += gap_ns
            told.append((t_ns, uid, status))
            last[uid] = status
    shown: dict[int, list[int]] = {}
    for step in steps_of(told):
        for uid, status in [*step.flashed, *step.changed]:
            if status > 1:
                shown.setdefault(uid, []).append(status)
    wanted: dict[int, list[int]] = {}
    for _, uid, status in told:
        if status > 1:
            wanted.setdefault(uid, []).append(status)
    assert shown == wanted
