"""Runs behaviour tests of a project in a worker; no Python of the project runs in them."""

from __future__ import annotations

import functools
import time
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from translator import Project
    from tree_gardener.errors import Diagnostic
    from tree_gardener.testing import Case, Result
    from tree_gardener.testing.job import Job

PROCESSOR_S: Final = 6.0
"""The processor time for all tests of one request; the tests after it are not run."""

LETTERS: Final = {"S": "SUCCESS", "F": "FAILURE", "R": "RUNNING", "K": "SKIPPED"}
"""The letters of an outcome's `seen`."""

PASSED, FAILED, NEEDS_PYTHON, NOT_RUN = "passed", "failed", "needs_python", "not_run"


def run_tests(
    files: dict[str, bytes], *, processor_s: float = PROCESSOR_S, with_job: bool = False
) -> dict[str, Any]:
    """Returns the results of the tests, the problems of their files, and the coverage of the trees.

    With `with_job` also the `job` with the project's Python, for the process that runs the other tests.

    Raises:
        TranslatorError: the project has errors.
    """
    from translator.shared_modules import sources_of  # noqa: PLC0415 - keeps the start of the server short
    from translator.tree import reachable_trees  # noqa: PLC0415 - as above
    from tree_gardener.testing.apart import bounded  # noqa: PLC0415 - as above

    project, job, problems = _job(files)
    suite = job.suite()
    cases, wrong = job.cases(suite)
    main = project.settings.main_tree
    roots = [*(case.tree or main for case in cases), *reachable_trees(project.trees, main)]
    coverage = suite.coverage(list(dict.fromkeys(roots)))
    told = []
    start_s = time.process_time()
    for case in cases:
        left_s = processor_s - (time.process_time() - start_s)
        if case.uses_real or left_s <= 0:
            told.append(_outcome(case, NEEDS_PYTHON if case.uses_real else NOT_RUN, None))
            continue
        result = bounded(functools.partial(suite.run, case), case, left_s)
        coverage.add_seen(result.seen)
        told.append(_outcome(case, PASSED if result.passed else FAILED, result))
    reached = coverage.to_json()
    return {
        "tests": told,
        "problems": [_problem(found) for found in [*problems, *wrong]],
        "coverage": {"share": reached["share"], "trees": reached["trees"]},
        **({"job": {**job.to_json(), "sources": sources_of(project)}} if with_job else {}),
    }


def run_coverage(files: dict[str, bytes], seen: dict[str, str]) -> dict[str, Any]:
    """Returns the coverage of the trees by runs of a whole project: ticked blocks and their results.

    Args:
        files: the project.
        seen: the results of each node of the tree that ran, by its path, as letters (`LETTERS`).

    Raises:
        TranslatorError: the project has errors.
    """
    from tree_gardener.testing.coverage import TICKED  # noqa: PLC0415 - as above

    project, job, _ = _job(files)
    return job.suite().run_coverage(
        project.settings.main_tree,
        {
            path: [TICKED, *(LETTERS[letter] for letter in letters if letter in LETTERS)]
            for path, letters in seen.items()
            if letters
        },
    )


def _job(files: dict[str, bytes]) -> tuple[Project, Job, list[Diagnostic]]:
    """Returns a project with the job of its tests, and the problems of their files.

    Raises:
        TranslatorError: the project has errors.
    """
    from translator import TranslatorError, load  # noqa: PLC0415 - as above
    from translator.behaviour_tests import errors_before_tests, to_job  # noqa: PLC0415
    from tree_gardener.testing.job import Job  # noqa: PLC0415

    project = load(files)
    errors = errors_before_tests(project)
    if errors:
        raise TranslatorError(errors)
    document, problems = to_job(project)
    return project, Job.from_json(document), problems


def _outcome(case: Case, outcome: str, result: Result | None) -> dict[str, Any]:
    return {
        "name": case.name,
        "file": case.file,
        "line": case.line,
        "tree": case.tree,
        "outcome": outcome,
        "ticks": result.ticks if result is not None else 0,
        "reached": result.seen if result is not None else {},
        "failures": [
            {
                "message": failure.message,
                "line": failure.line,
                "tick": failure.tick,
                "time_s": failure.time_s,
                "node": failure.node,
                "tree": failure.tree,
                "node_id": failure.node_id,
                "wanted": failure.wanted,
                "got": failure.got,
                "path": [{"name": name, "status": status} for name, status in failure.path],
            }
            for failure in (result.failures if result is not None else ())
        ],
    }


def _problem(found: Diagnostic) -> dict[str, Any]:
    """Returns a problem in the form of the translator's diagnostics."""
    return {
        "code": found.code,
        "severity": found.severity,
        "message": found.message,
        "hint": found.hint,
        "values": {},
        "tree": found.tree,
        "node": found.node_id,
        "port": found.port,
        "file": found.file,
        "line": found.line or None,
        "column": found.column or None,
    }
