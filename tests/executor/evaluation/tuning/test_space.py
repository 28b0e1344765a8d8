"""The ports that are tuned."""

import dataclasses

import pytest

from executor.evaluation.plan import make_plan
from executor.evaluation.tuning.space import Port, TuningError, apply, read_ports, today
from tests.executor.evaluation.projects import project

TEXT = "duration_s: 1\nruns: 2\n{}judge: {{success: [{{never: collision}}]}}\n"
PLAN = make_plan(project(TEXT.format("")), "main")


def test_a_port_is_read_with_its_bounds_and_kind():
    [speed, count] = read_ports(["MainTree.go.speed=0.1..0.6", "ports.MainTree.a.count = 1..20"], PLAN)
    assert speed == Port("MainTree.go.speed", "MainTree", "a", "speed", 0.1, 0.6)
    assert (count.address, count.low, count.high, count.whole) == ("MainTree.a.count", 1, 20, True)
    [below] = read_ports(["MainTree.go.speed=-1e-1..2"], PLAN)
    assert (below.low, below.high) == (-0.1, 2)


@pytest.mark.parametrize(
    ("texts", "words"),
    [
        (["MainTree.go.speed"], "write a port with its bounds"),
        (["MainTree.go.speed=a..b"], "write a port with its bounds"),
        (["MainTree.go.speed=2..1"], "the lower one first"),
        (["MainTree.go.speed=1..inf"], "the lower one first"),
        (["MainTree.go.sped=0..1"], "there is no such port; there are MainTree.a.count"),
        (["MainTree.go.speed=0..1", "MainTree.a.speed=0..1"], "named twice"),
    ],
)
def test_what_is_no_port_says_why(texts, words):
    with pytest.raises(TuningError, match=words):
        read_ports(texts, PLAN)


def test_a_port_that_the_evaluation_draws_has_no_value_to_tune():
    plan = make_plan(project(TEXT.format("vary: {ports.MainTree.go.speed: [0, 1]}\n")), "main")
    with pytest.raises(TuningError, match="draws it"):
        read_ports(["MainTree.a.speed=0..1"], plan)


def test_values_are_those_of_the_project_afterwards():
    [speed, count] = read_ports(["MainTree.go.speed=0.1..0.6", "MainTree.go.count=1..20"], PLAN)
    assert today(PLAN.project, [speed, count]) == {"MainTree.go.speed": "", "MainTree.go.count": ""}
    changed = apply(PLAN.project, {speed: 0.25, count: 7})
    assert today(changed, [speed, count]) == {"MainTree.go.speed": "0.25", "MainTree.go.count": "7"}
    assert today(PLAN.project, [speed]) == {"MainTree.go.speed": ""}
    assert speed.value("0.5") == 0.5
    assert dataclasses.replace(speed, whole=True).value("2.0") == 2
