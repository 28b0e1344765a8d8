"""The lines of `runs.jsonl`."""

import pytest

from executor.evaluation.outcome import COUNTED, NOT_COUNTED, Outcome, read_outcome


def test_a_line_is_read_as_it_was_written():
    outcome = Outcome(
        7, "failure", "</script>\nü", 3.25, measures={"path_length_m": 1.5}, path=[[0.0, 1.0, 2.0]]
    )
    line = outcome.to_line()
    assert "\n" not in line
    assert read_outcome(line) == outcome


@pytest.mark.parametrize(
    "line", ["", "[]", "{}", '{"seed": 1, "outcome": "great"}', '{"seed": true, "outcome": "success"}', "3"]
)
def test_other_lines_are_refused(line):
    with pytest.raises(ValueError):  # noqa: PT011 - JSON's errors are of this kind too
        read_outcome(line)


def test_what_counts():
    assert all(Outcome(1, name).is_counted for name in COUNTED)
    assert not any(Outcome(1, name).is_counted for name in NOT_COUNTED)
    assert [name for name in COUNTED if Outcome(1, name).is_success] == ["success"]
