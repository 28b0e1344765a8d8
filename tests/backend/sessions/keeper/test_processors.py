"""Which processors users' code may use."""

from __future__ import annotations

import pytest

from backend.sessions.keeper.plan import read_plan
from backend.sessions.keeper.processors import VARIABLE, of_containers


@pytest.mark.parametrize(
    ("available", "expected"),
    [
        ([0], (0,)),
        ([0, 1], (0, 1)),
        ([0, 1, 2, 3], (1, 2, 3)),
        ([1, 3, 5, 7, 9, 11, 13, 15], (5, 7, 9, 11, 13, 15)),
    ],
)
def test_a_quarter_is_reserved_by_default(available, expected):
    assert of_containers({}, available) == expected


def test_the_variable_chooses():
    assert of_containers({VARIABLE: "1"}, [0, 1]) == (1,)
    assert of_containers({VARIABLE: "0"}, range(8)) == tuple(range(8))


@pytest.mark.parametrize("text", ["2", "-1", "many", "1.5"])
def test_what_cannot_be_reserved_is_refused_by_name(text):
    with pytest.raises(ValueError, match=VARIABLE):
        of_containers({VARIABLE: text}, [0, 1])


def test_sessions_and_tools_run_on_the_others():
    plan = read_plan({VARIABLE: "0"}, gate_source="gate", stack="stack")
    free = ",".join(map(str, plan.processors))
    for body in (plan.container("id", "token", 1, "door"), plan.tools("id", "token", "door")):
        assert body["HostConfig"]["CpusetCpus"] == free
