"""The typed records that judges get."""

import pytest

from executor.evaluation.truth import Sample, Truth


def test_a_truth_knows_its_time_and_its_areas():
    truth = Truth({"box": ((0, 0), (1, 0), (1, 1), (0, 1))})
    assert truth.time_s == 0
    truth.samples.append(Sample(2.5, 0.5, 0.5, 0, {}, "RUNNING"))
    assert truth.time_s == 2.5
    assert truth.is_inside("box", 0.5, 0.5)
    assert not truth.is_inside("box", 1.5, 0.5)
    with pytest.raises(KeyError):
        truth.is_inside("ball", 0, 0)
