"""A tree of py_trees becomes blocks that tick as it does, beside py_trees itself; or one block."""

from __future__ import annotations

import operator
import random
from typing import TYPE_CHECKING, Any

import py_trees
import pytest
from py_trees.common import ComparisonExpression, ParallelPolicy
from py_trees.common import Status as PyTreesStatus

from executor.expansion.py_trees_file import describe, note_arguments
from translator import check, to_xml
from translator.py_trees_tree import project_of_py_trees
from tree_gardener import Tree

if TYPE_CHECKING:
    from collections.abc import Iterator

    from py_trees.behaviour import Behaviour

TREES = 50
TICKS = 12
RESULTS = {"S": "SUCCESS", "F": "FAILURE", "R": "RUNNING"}
LOG: list[tuple[str, str]] = []


class Play(py_trees.behaviour.Behaviour):
    """Plays results in turn, and logs its ticks."""

    def __init__(self, name: str, results: str = "S") -> None:
        super().__init__(name)
        self.results = results
        self.ticks = 0

    def update(self) -> PyTreesStatus:
        """Returns the next result."""
        result = {"S": "SUCCESS", "F": "FAILURE", "R": "RUNNING"}[
            self.results[self.ticks % len(self.results)]
        ]
        self.ticks += 1
        LOG.append((self.name, result))
        return PyTreesStatus[result]


class Own(py_trees.composites.Sequence):
    """A composite of the user."""


def plain(cls: Any, *_arguments: Any, **_named: Any) -> Any:
    return object.__new__(cls)


@pytest.fixture(autouse=True)
def noted() -> Iterator[None]:
    note_arguments()
    LOG.clear()
    yield
    py_trees.behaviour.Behaviour.__new__ = plain  # object's own would refuse arguments from now on


def some_tree(rng: random.Random, depth: int, names: Iterator[int]) -> Behaviour:
    """Returns a random tree of leaves, composites and decorators."""
    name, kind = f"n{next(names)}", rng.choice(KINDS if depth else KINDS[:2])
    if kind == "shipped":
        behaviours = py_trees.behaviours
        return rng.choice([behaviours.Success, behaviours.Failure, behaviours.Running])(name)
    if kind == "play":
        return Play(name, results="".join(rng.choice("SSFFR") for _ in range(rng.randint(1, 4))))
    least = 0 if rng.random() < 0.05 else 1
    count = rng.randint(least, 3) if kind in COMPOSITES else 1
    children = [some_tree(rng, depth - 1, names) for _ in range(count)]
    if kind in COMPOSITES:
        return COMPOSITES[kind](name, rng, children)
    return rng.choice(DECORATORS)(name, children[0])


def parallel(name: str, rng: random.Random, children: list[Behaviour]) -> Behaviour:
    is_synchronised = rng.random() < 0.5
    policy = rng.choice([ParallelPolicy.SuccessOnAll(is_synchronised), ParallelPolicy.SuccessOnOne()])
    return py_trees.composites.Parallel(name, policy, children)


KINDS = (
    "shipped",
    "play",
    "play",
    "sequence",
    "sequence",
    "selector",
    "selector",
    "parallel",
    *["decorator"] * 4,
)
COMPOSITES: dict[str, Any] = {
    "sequence": lambda name, rng, children: py_trees.composites.Sequence(name, rng.random() < 0.5, children),
    "selector": lambda name, rng, children: py_trees.composites.Selector(name, rng.random() < 0.5, children),
    "parallel": parallel,
}
DECORATORS: list[Any] = [
    *(
        py_trees.decorators.Inverter,
        py_trees.decorators.FailureIsSuccess,
        py_trees.decorators.SuccessIsFailure,
    ),
    *(py_trees.decorators.RunningIsFailure, py_trees.decorators.FailureIsRunning),
    *(py_trees.decorators.SuccessIsRunning, py_trees.decorators.PassThrough),
    lambda name, child: py_trees.decorators.Retry(name, child, 3),
    lambda name, child: py_trees.decorators.Repeat(name=name, child=child, num_success=2),
    lambda name, child: py_trees.decorators.OneShot(name, child, py_trees.common.OneShotPolicy.ON_COMPLETION),
]


def imported(root: Behaviour) -> tuple[Any, str]:
    description = {"module": "robot_tree", "expression": "create_root()", "root": describe(root)}
    return project_of_py_trees(
        description, {"robot_tree.py": b"def create_root():\n    return None\n"}, file="robot_tree.py"
    )


def classes_of(project: Any) -> dict[str, Any]:
    found = {}
    for name, action in project.actions.items():
        space: dict[str, Any] = {"__name__": f"actions.{name}"}
        exec(action.source, space)  # noqa: S102 - our own text
        found[name] = space[name]
    return found


@pytest.mark.parametrize("seed", range(TREES))
def test_the_imported_tree_ticks_as_py_trees_does(seed: int) -> None:
    root = some_tree(random.Random(seed), 4, iter(range(10_000)))  # noqa: S311 - no secret
    project, why = imported(root)
    assert why == ""
    nodes = classes_of(project)
    expected = []
    for _ in range(TICKS):
        LOG.clear()
        root.tick_once()
        expected.append((root.status.name, LOG.copy()))
    tree = Tree.from_xml(to_xml(project), nodes=nodes)
    tree.setup()
    for number, (status, log) in enumerate(expected):
        LOG.clear()
        result = tree.tick_exactly_once()
        assert (number, result.name, LOG) == (number, status, log)


def test_arguments_are_written_as_python_writes_them() -> None:
    checked = ComparisonExpression("battery", 0.5, operator.lt)
    root = py_trees.composites.Sequence(
        "s",
        memory=True,
        children=[
            Play("a", "RF"),
            Play("b", results="RF"),
            Play("c"),
            py_trees.behaviours.CheckBlackboardVariableValue("low", checked),
            py_trees.behaviours.StatusQueue("q", [PyTreesStatus.RUNNING], None),
        ],
    )
    project, why = imported(root)
    assert why == ""
    assert set(project.actions) == {"Play", "Play2", "CheckBlackboardVariableValue", "StatusQueue"}
    assert "super().__init__(name=name, results='RF')" in project.actions["Play"].source
    assert "ComparisonExpression('battery', 0.5, operator.lt)" in (
        project.actions["CheckBlackboardVariableValue"].source
    )
    assert [item.code for item in check(project) if item.is_error] == []
    classes_of(project)


@pytest.mark.parametrize(
    ("make", "why"),
    [
        (lambda: Own("own", memory=True, children=[Play("a")]), "Own of 'own' is a composite of its own"),
        (
            lambda: py_trees.decorators.EternalGuard("g", Play("a"), condition=lambda: True),
            "the class EternalGuard of 'g' is made with more than plain values",
        ),
        (
            lambda: py_trees.composites.Parallel("p", ParallelPolicy.SuccessOnSelected([]), [Play("a")]),
            "'p' succeeds on selected children",
        ),
    ],
)
def test_a_tree_with_a_class_that_has_no_form_is_one_block(make: Any, why: str) -> None:
    project, said = imported(make())
    assert said == why
    (name,) = project.actions
    assert name == "RobotTree"
    assert "super().__init__(name, child=robot_tree.create_root())" in project.actions[name].source
    model = project.actions[name]
    assert (model.min_children, model.max_children) == (0, 0)
    assert [item.code for item in check(project) if item.is_error] == []


def test_names_of_the_library_and_of_modules_are_not_taken() -> None:
    description = {"module": "Play", "expression": "root", "root": describe(Play("a"))}
    project, _ = project_of_py_trees(description, {"Play.py": b"x = 1\n"}, file="Play.py")
    assert "Play2" in project.actions
    root = describe(py_trees.decorators.Timeout("t", Play("a"), duration=2.0))
    project, _ = project_of_py_trees({**description, "root": root}, {}, file="t.py")
    assert set(project.actions) == {"PyTreesTimeout", "Play"}
