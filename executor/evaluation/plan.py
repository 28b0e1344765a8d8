"""Reads an evaluation of a project, and checks all that it names before anything runs."""

from __future__ import annotations

import difflib
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor.evaluation.document import ENDING, FOLDER, Evaluation
from executor.evaluation.drawing import bounds_of
from executor.evaluation.faults import fault_problems
from executor.evaluation.sealed.confine import require_seal
from executor.evaluation.variation import Target, port_text, resolve, targets
from executor.headless.files import write_files
from executor.robots.config import RobotConfig, load_robot
from executor.universes.document import DocumentError, Located, Problem, read_yaml, text_of
from executor.universes.loader import validate
from executor.world.simulation.launch import find_universe
from translator.check import check
from translator.diagnostic import TranslatorError, errors_in
from translator.settings import NO_UNIVERSE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from executor.universes.model import Universe
    from translator import Project

_GROUPS: Final = ("anything", "models", "actors", "robots")


class EvaluationError(Exception):
    """The project cannot be evaluated; the text is the reason."""


@dataclass(frozen=True)
class Plan:
    """An evaluation of a project, read and checked.

    `configs` are those of the universe's robots; `judged_by` names the project that the evaluation is of, if
    it is another one, and `origin` is the project that it was read with.
    """

    project: Project
    name: str
    evaluation: Evaluation
    universe: Universe
    configs: tuple[RobotConfig, ...]
    targets: dict[str, Target] = field(default_factory=dict)
    to_the_end: bool = False
    sealed: bool = False
    judged_by: str | None = None
    origin: Project | None = None

    @property
    def file(self) -> str:
        """The path of the evaluation in the project."""
        return f"{FOLDER}{self.name}{ENDING}"

    def with_project(self, project: Project) -> Plan:
        """Returns the plan for another version of the trees and actions, in the same worlds.

        Raises:
            DocumentError: an entry names nothing in the other version.
            TranslatorError: the other version has errors.
        """
        errors = errors_in(check(project))
        if errors:
            raise TranslatorError(errors)
        other = replace(self, project=project, origin=self.origin or self.project)
        known = targets(self.universe, self.configs[0] if self.configs else None, project)
        found, problems = resolve(self.evaluation, known, self.universe, lambda _: (1, 1))
        if problems:
            raise DocumentError(problems, self.file)
        return replace(other, targets=found)


def evaluation_names(project: Project) -> list[str]:
    """Returns the names of a project's evaluations."""
    return sorted(
        path.removeprefix(FOLDER).removesuffix(ENDING)
        for path in project.files
        if path.startswith(FOLDER) and path.endswith(ENDING) and "/" not in path.removeprefix(FOLDER)
    )


def read_evaluation(project: Project, name: str) -> tuple[Evaluation, Located]:
    """Reads the file of an evaluation, and looks at nothing else.

    Raises:
        EvaluationError: there is no such evaluation.
        DocumentError: it is wrong; the error has every problem.
    """
    names = evaluation_names(project)
    file = f"{FOLDER}{name}{ENDING}"
    if name not in names:
        near = difflib.get_close_matches(name, names, n=1)
        hint = f"did you mean {near[0]!r}?" if near else f"there are: {', '.join(names) or 'none'}"
        raise EvaluationError(f"{file}:1:1: there is no such evaluation ({hint})")
    located = read_yaml(text_of(project.files[file], file), file)
    return validate(located, Evaluation, file), located


def make_plan(project: Project, name: str) -> Plan:
    """Reads and checks an evaluation.

    Raises:
        EvaluationError: there is no such evaluation, or the project cannot be evaluated.
        DocumentError: the evaluation, its universe or its robot is wrong; the error has every problem.
        TranslatorError: the project has errors.
    """
    evaluation, located = read_evaluation(project, name)
    errors = errors_in(check(project))
    if errors:
        raise TranslatorError(errors)
    universe, configs = _open_world(project, evaluation)
    known = targets(universe, configs[0] if configs else None, project)
    found, problems = resolve(evaluation, known, universe, located.place)
    plan = Plan(project, name, evaluation, universe, configs, found)
    problems += _sensor_problems(plan, located) + _port_problems(plan, located)
    problems += [*_judge_problems(plan, located.place), *fault_problems(plan, located.place)]
    if problems:
        raise DocumentError(sorted(problems, key=lambda problem: (problem.line, problem.column)), plan.file)
    return plan


def sealed(plan: Plan) -> Plan:
    """Returns the plan with sealed runs.

    Raises:
        EvaluationError: the result would rest on what the actions claim alone.
        SealError: this machine cannot seal a process.
    """
    require_seal()
    if all(item.kind == "tree" for item in plan.evaluation.judge.success):
        raise EvaluationError(
            f"{plan.file}:1:1: the judge asks for the result of the tree alone, which sealed actions only "
            "claim (add a criterion on the world, such as `reach` or `never: collision`)"
        )
    return replace(plan, sealed=True)


def _open_world(project: Project, evaluation: Evaluation) -> tuple[Universe, tuple[RobotConfig, ...]]:
    name = evaluation.universe or project.settings.universe
    if name == NO_UNIVERSE:
        raise EvaluationError(
            "project.json:1:1: a project without a simulated world (universe none) cannot be evaluated"
        )
    file = f"universes/{name}.yaml"
    own = project.files.get(file)
    universe = find_universe(text_of(own, file) if own is not None else name, file)
    if not universe.robots:
        raise EvaluationError(f"{file}:1:1: the world has no robot, so there is nothing to judge")
    with tempfile.TemporaryDirectory(prefix="bt-studio-") as folder:
        write_files(
            Path(folder), {k: v for k, v in project.files.items() if k.startswith(("assets/", "robots/"))}
        )
        robot = evaluation.robot or project.settings.robot
        configs = tuple(load_robot(robot or place.model, Path(folder)) for place in universe.robots)
    return universe, configs


def _sensor_problems(plan: Plan, located: Located) -> list[Problem]:
    """Tries the bounds of each sensor's value on the robot's configuration."""
    problems = []
    config = plan.configs[0]
    all_: list[Any] = [*config.lidars, *config.cameras, *config.imus, *config.bumpers, *config.batteries]
    sensors: dict[str, Any] = {sensor.name: sensor for sensor in all_}
    for address, target in plan.targets.items():
        if target.kind != "sensor":
            continue
        sensor = sensors[target.owner[0]]
        for value in bounds_of(plan.evaluation.vary[address]):
            try:
                type(sensor).model_validate({**sensor.model_dump(), target.field: value})
            except ValueError as error:
                message = f"{address}: {value} is out of its bounds: {error.errors()[0]['msg']}"  # type: ignore[attr-defined]  # pydantic's
                problems.append(Problem(message, *located.place(("vary", address)), "BTV002"))
                break
    return problems


def _port_problems(plan: Plan, located: Located) -> list[Problem]:
    """Tries the bounds of each port's value on the project: they must not bring errors of the check."""
    problems = []
    for address, target in plan.targets.items():
        if target.kind != "port":
            continue
        tree_id, node_id = target.owner
        tree = plan.project.trees[tree_id]
        for value in bounds_of(plan.evaluation.vary[address]):
            if (
                target.whole
                and isinstance(value, float)
                and plan.evaluation.vary[address].uniform is not None
            ):
                value = round(value)  # noqa: PLW2901 - as it will be drawn
            ports = {**tree.nodes[node_id].ports, target.field: port_text(value, real=target.real)}
            found = errors_in(check(plan.project.with_tree(tree.edited(node_id, ports=ports))))
            if found:
                text = (
                    f"{address}: {port_text(value, real=target.real)} cannot be its value: {found[0].message}"
                )
                problems.append(Problem(text, *located.place(("vary", address)), "BTV002"))
                break
    return problems


def _judge_problems(plan: Plan, place: Callable[..., tuple[int, int]]) -> Iterator[Problem]:
    """Yields the judge's references to things that do not exist, and its items that can never be met."""
    evaluation, universe = plan.evaluation, plan.universe
    solids = {model.id for model in universe.models if model.solid}
    words = {*_GROUPS, *solids, *(a.id for a in universe.actors), *(r.id for r in universe.robots[1:])}
    for index, item in enumerate(evaluation.judge.success):
        path = ("judge", "success", index)
        named = [item.reach.area] if item.reach is not None else list(item.visit or ())
        for area in named:
            if area not in universe.areas:
                there = ", ".join(universe.areas) or "none; add `areas` to it"
                yield Problem(
                    f"the world has no area {area!r}",
                    *place((*path, item.kind)),
                    "BTV003",
                    f"it has: {there}",
                )
        if item.deadline_s is not None and item.deadline_s > evaluation.duration_s:
            text = f"within_s is {item.deadline_s:g}, and a run takes {evaluation.duration_s:g} s at most"
            yield Problem(
                text, *place((*path, item.kind)), "BTV004", "make duration_s longer, or leave within_s out"
            )
        if item.never is not None and item.never.closer_than_m is not None and item.never.to not in words:
            near = difflib.get_close_matches(item.never.to, words, n=1)
            hint = f"did you mean {near[0]!r}?" if near else f"use {', '.join(_GROUPS)}, or an id"
            yield Problem(
                f"there is no {item.never.to!r} to be close to",
                *place((*path, "never", "to")),
                "BTV003",
                hint,
            )
        if item.python is not None and python_file(item.python) not in plan.project.files:
            text = f"there is no file {python_file(item.python)}"
            yield Problem(text, *place((*path, "python")), "BTV003", f"write it beside {plan.file}")


def python_file(name: str) -> str:
    """Returns the path in the project of the file of `file.py:function`."""
    return FOLDER + name.partition(":")[0]
