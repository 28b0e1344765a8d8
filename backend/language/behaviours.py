"""Behaviour tests with leaves that are `real`, whose Python runs where the user's tools run, never here.

On localhost that is a child process of `executor.tools.behaviours`, known by its command alone; on a server
with containers the user's own container.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Final

import msgspec
from msgspec import Meta

from backend.config.environment import REPOSITORY, environment
from backend.language import tools
from backend.language.errors import CheckerUnavailableError

if TYPE_CHECKING:
    from collections.abc import Callable

    from backend.accounts.models import User
    from backend.core.processes.stops import Stop

    Run = Callable[[str, Stop], str]
    """Runs the tests of a text, and returns the text of the answer; "" if there is none."""

DEADLINE_S: Final = 90.0
CHILD: Final = "executor.tools.behaviours"
NEEDS_PYTHON: Final = "needs_python"
_MISSING: Final = "This server has no containers, and without them it runs no Python of tests."
_Text = Annotated[str, Meta(max_length=100_000)]
_Count = Annotated[int, Meta(ge=0, le=10**9)]


class _Failure(msgspec.Struct):
    message: _Text
    line: _Count
    tick: _Count
    time_s: float
    node: _Text
    tree: _Text
    node_id: _Text
    wanted: _Text
    got: _Text
    path: Annotated[list[tuple[_Text, _Text]], Meta(max_length=10_000)]


class _Result(msgspec.Struct):
    """A result, as the process of the tests wrote it; the project's Python may have changed it."""

    name: _Text
    file: _Text
    ticks: _Count
    failures: Annotated[list[_Failure], Meta(max_length=10_000)]
    seen: dict[str, dict[str, list[str]]]


class _Answer(msgspec.Struct):
    results: Annotated[list[_Result], Meta(max_length=100_000)]


def runner(user: User) -> Run:
    """Returns the function that runs such tests.

    Raises:
        CheckerUnavailableError: this server cannot.
    """
    if environment().has_containers:
        return partial(tools.run_behaviours, user)
    if environment().is_team:
        raise CheckerUnavailableError(_MISSING)
    return run_beside


def run_beside(text: str, stop: Stop) -> str:
    """Runs the tests in a child of this process, which gets nothing of its environment.

    Raises:
        StoppedError: the tests were ended before.
    """
    with subprocess.Popen(
        [sys.executable, "-m", CHILD],
        cwd=REPOSITORY,
        env={key: os.environ[key] for key in ("PATH", "LANG", "LC_ALL") if key in os.environ},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    ) as child:
        number = os.pidfd_open(child.pid)  # `communicate` frees the number of the process
        end = partial(_end, number)
        try:
            stop.bind(end)
            output, _ = child.communicate(text.encode(), DEADLINE_S)
        except subprocess.TimeoutExpired:
            return ""
        finally:
            stop.release()
            end()
            os.close(number)
    return output.decode(errors="replace") if child.returncode == 0 else ""


def _end(number: int) -> None:
    """Ends the child; the processes of its tests end with it."""
    with contextlib.suppress(ProcessLookupError):
        signal.pidfd_send_signal(number, signal.SIGKILL)


def needs_python(report: dict[str, Any]) -> bool:
    """Returns whether tests of a report are left that need Python."""
    return any(test["outcome"] == NEEDS_PYTHON for test in report["tests"])


def completed(report: dict[str, Any], job: dict[str, Any], run: Run, stop: Stop) -> dict[str, Any]:
    """Returns a report of tests with the results of those that need Python; those without one are not run.

    Raises:
        CheckerUnavailableError: there is no answer.
        StoppedError: the tests were ended before.
    """
    left = [test for test in report["tests"] if test["outcome"] == NEEDS_PYTHON]
    if not left:
        return report
    asked = {"job": job, "run": [[test["file"], test["name"]] for test in left]}
    try:
        found = msgspec.json.decode(run(json.dumps(asked), stop) or "null", type=_Answer)
    except (msgspec.DecodeError, UnicodeError) as error:
        raise CheckerUnavailableError("The process of the tests gave no answer.") from error
    by = {(result.file, result.name): result for result in found.results}
    tests = [_with(test, by.get((test["file"], test["name"]))) for test in report["tests"]]
    return {**report, "tests": tests, "coverage": _covered(report["coverage"], found.results)}


def _with(test: dict[str, Any], result: _Result | None) -> dict[str, Any]:
    if test["outcome"] != NEEDS_PYTHON:
        return test
    if result is None:
        return {**test, "outcome": "not_run"}
    failures = [
        {
            **{name: value for name, value in msgspec.structs.asdict(failure).items() if name != "path"},
            "path": [{"name": name, "status": status} for name, status in failure.path],
        }
        for failure in result.failures
    ]
    outcome = "failed" if failures else "passed"
    return {
        **test,
        "outcome": outcome,
        "ticks": result.ticks,
        "reached": result.seen,
        "failures": failures,
    }


def _covered(coverage: dict[str, Any], results: list[_Result]) -> dict[str, Any]:
    """Adds what results have reached to a coverage, which names all that can be reached."""
    trees = {}
    for tree, covered in coverage["trees"].items():
        nodes = {}
        for node, about in covered["nodes"].items():
            seen = {item for result in results for item in result.seen.get(tree, {}).get(node, ())}
            items = {item: reached or item in seen for item, reached in about["items"].items()}
            nodes[node] = {**about, "items": items}
        trees[tree] = {**covered, "nodes": nodes, "share": _share([nodes])}
    return {**coverage, "trees": trees, "share": _share([tree["nodes"] for tree in trees.values()])}


def _share(trees: list[dict[str, Any]]) -> float:
    items = [reached for nodes in trees for node in nodes.values() for reached in node["items"].values()]
    return round(sum(items) / len(items), 6) if items else 1.0
