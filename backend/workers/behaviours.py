"""Runs behaviour tests of a project in a worker; no Python of the project runs in them."""

from __future__ import annotations

import functools
import logging
import time
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Sequence

    from translator import Project
    from translator.diagnostic import Diagnostic as TreeDiagnostic
    from tree_gardener.errors import Diagnostic
    from tree_gardener.testing import Case, Result
    from tree_gardener.testing.job import Job

log = logging.getLogger(__name__)

PROCESSOR_S: Final = 6.0
"""The processor time for all tests of one request; the tests after it are not run."""
CHECK_S: Final = 2.0
"""The processor time to find what is wrong with the tests, after each save: a part of the job's deadline."""

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


def problems(project: Project, checked: Sequence[TreeDiagnostic]) -> list[dict[str, Any]]:
    """Returns what keeps the tests of a project from being run, as diagnostics of the translator.

    If they cannot be checked, or only beyond `CHECK_S`, one diagnostic says so: the report of the project
    must not fail with them.
    """
    import tree_gardener.testing.job  # noqa: PLC0415, F401 - the limits do not count its import
    from translator.diagnostic import Place, diagnostic  # noqa: PLC0415 - as above
    from tree_gardener.testing.limits import OverLimitError, memory, processor_time  # noqa: PLC0415

    try:
        with memory(), processor_time(CHECK_S):
            return [_problem(found) for found in problems_of_tests(project, checked)]
    except OverLimitError:
        reason = f"they need more than {CHECK_S:g} s of processor time"
    except MemoryError:
        reason = "they need too much memory"
    except Exception as error:
        log.exception("the tests of a project could not be checked")
        reason = type(error).__name__
    return [diagnostic("BT0025", Place(), problem=reason).to_json()]


def problems_of_tests(project: Project, checked: Sequence[TreeDiagnostic] | None = None) -> list[Diagnostic]:
    """Returns what keeps the tests of a project from being run, as running them would report it.

    No tree is ticked. The names of trees, nodes and ports are looked at only if the trees have no errors.

    Args:
        project: the project.
        checked: what the translator's check found in it; without it, the project is checked now.
    """
    from translator.behaviour_tests import (  # noqa: PLC0415 - as above
        errors_before_tests,
        paths_of_tests,
        read_files,
        to_job,
    )
    from tree_gardener.testing.job import Job  # noqa: PLC0415 - as above
    from tree_gardener.testing.reading import read_tests  # noqa: PLC0415 - as above

    if not paths_of_tests(project.files):
        return []
    if not errors_before_tests(project, checked):
        document, found = to_job(project)
        job = Job.from_json(document)
        return found + job.cases(job.suite())[1]
    read, found = read_files(project.files)
    for path, text in read.items():
        found += read_tests(text.value, path, text.place)[1]
    return found


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
