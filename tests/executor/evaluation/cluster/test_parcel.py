"""A parcel brings a plan to another machine as it is."""

import dataclasses

import msgspec
import pytest

from executor.evaluation.cluster.parcel import pack, unpack
from executor.evaluation.plan import make_plan
from executor.evaluation.results import inputs_of
from tests.executor.evaluation.projects import DRIVE, project

TEXT = "duration_s: 1\nruns: 2\njudge: {success: [{never: collision}]}\n"


def test_a_plan_arrives_as_it_was():
    plan = dataclasses.replace(make_plan(project(TEXT), "main"), to_the_end=True, sealed=True)
    found = unpack(pack(plan))
    assert inputs_of(found) == inputs_of(plan)
    assert (found.universe, found.configs, found.evaluation) == (plan.universe, plan.configs, plan.evaluation)


def test_the_project_that_judges_travels_along():
    judge = make_plan(project(TEXT), "main")
    plan = judge.with_project(project(TEXT.replace("duration_s: 1", "duration_s: 9"), action=DRIVE + "\n"))
    found = unpack(pack(plan))
    assert found.evaluation.duration_s == 1
    assert found.project.files["actions/Drive.py"].endswith(b"\n\n")


def test_other_data_is_refused():
    with pytest.raises(msgspec.DecodeError):
        unpack(b"\xc1")
