"""The evaluation of every behaviour of the library is sound."""

from __future__ import annotations

import pytest

from backend.catalog.library import LIBRARY, behaviours
from executor.evaluation.plan import make_plan
from tests.backend.catalog.library_evaluations import project, write
from translator import load, open_path
from translator.check import check

IDS = [behaviour.id for behaviour in behaviours()]


def test_no_behaviour_is_without_one_and_none_is_left_over():
    assert sorted(path.stem for path in LIBRARY.glob("evaluations/*.yaml")) == sorted(IDS)


@pytest.mark.parametrize("behaviour", IDS)
def test_it_has_a_plan_and_its_project_no_error(behaviour, tmp_path):
    assert [found for found in check(load(project(behaviour))) if found.severity == "error"] == []
    plan = make_plan(open_path(write(behaviour, tmp_path)), behaviour)
    assert plan.evaluation.most_runs >= 50
    assert plan.evaluation.vary
    assert plan.evaluation.judge.success
