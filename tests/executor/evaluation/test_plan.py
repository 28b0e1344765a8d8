"""All that an evaluation names is checked before anything runs."""

import dataclasses

import pytest

from executor.evaluation.plan import EvaluationError, evaluation_names, make_plan, python_file
from executor.universes.document import DocumentError
from tests.executor.evaluation.projects import project
from translator import TranslatorError

GOOD = "duration_s: 5\nruns: 2\njudge: {success: [{never: collision}]}\n"


def test_a_plan_holds_universe_and_robot():
    plan = make_plan(project(GOOD), "main")
    assert (plan.name, plan.file, plan.universe.name) == ("main", "evaluations/main.yaml", "Yard")
    assert [config.id for config in plan.configs] == ["turtle2"]
    assert evaluation_names(plan.project) == ["main"]
    assert python_file("judge.py:quality") == "evaluations/judge.py"


def test_another_version_runs_in_the_same_worlds():
    plan = make_plan(project(GOOD + "vary: {ports.MainTree.go.speed: [0, 1]}\n"), "main")
    other = plan.with_project(project(GOOD))
    assert other.universe is plan.universe
    assert other.targets == plan.targets
    nodes = '{"a": {"type": "AlwaysSuccess"}}'
    without = (
        f'{{"format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "a", "nodes": {nodes}}}'
    )
    with pytest.raises(DocumentError, match="names nothing"):
        plan.with_project(project(GOOD, **{"trees/MainTree.json": without}))


@pytest.mark.parametrize(
    ("judge", "words"),
    [
        ("{reach: {area: nowhere}}", "no area 'nowhere' (it has: start, ahead, behind)"),
        ("{visit: [start, nowhere]}", "no area 'nowhere'"),
        ("{reach: {area: start, within_s: 9}}", "within_s is 9, and a run takes 5 s at most"),
        ("{never: {closer_than_m: 1, to: cratt}}", "no 'cratt' to be close to (did you mean 'crate'?)"),
        ("{never: {closer_than_m: 1, to: carpet}}", "no 'carpet' to be close to"),
        ("{python: judge.py:quality, at_least: {a: 1}}", "there is no file evaluations/judge.py"),
    ],
)
def test_what_the_judge_names_must_exist(judge, words):
    with pytest.raises(DocumentError) as caught:
        make_plan(project(GOOD.replace("{never: collision}", judge)), "main")
    assert words in str(caught.value)
    assert str(caught.value).startswith("evaluations/main.yaml:5:")


@pytest.mark.parametrize(
    ("text", "others", "words"),
    [
        ("universe: none\n" + GOOD, {}, "universe none"),
    ],
)
def test_a_project_that_cannot_be_evaluated_says_why(text, others, words):
    with pytest.raises(EvaluationError, match=words):
        make_plan(project(text, **others), "main")


def test_names_and_errors_of_the_project():
    with pytest.raises(EvaluationError, match="did you mean 'main'"):
        make_plan(project(GOOD), "mian")
    with pytest.raises(DocumentError, match="no world 'nirgends'"):
        make_plan(project("universe: nirgends\n" + GOOD), "main")
    with pytest.raises(TranslatorError):
        make_plan(project(GOOD, action="class Drive(", name="Drive"), "main")
    read = project(GOOD)
    broken = dataclasses.replace(read, files={**read.files, "evaluations/main.yaml": b"\xff"})
    with pytest.raises(DocumentError, match="not UTF-8"):
        make_plan(broken, "main")
