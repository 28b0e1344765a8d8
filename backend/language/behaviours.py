"""Behaviour tests with leaves that are `real`, whose Python runs where the user's tools run, never here.

On localhost that is a child process of `executor.tools.behaviours`, known by its command alone; on a server
with containers the user's own container.
"""

from __future__ import annotations

import json
import os
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

    Run = Callable[[str], str]
    """Runs the tests of a text, and returns the text of the answer; "" if there is none."""

DEADLINE_S: Final = 90.0
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
    if environment().launcher == "docker":
        return partial(tools.run_behaviours, user)
    if environment().mode == "team":
        raise CheckerUnavailableError(_MISSING)
    return run_beside


def run_beside(text: str) -> str:
    """Runs the tests in a child of this process, which gets nothing of its environment."""
    try:
        done = subprocess.run(
            [sys.executable, "-m", "executor.tools.behaviours"],
            cwd=REPOSITORY,
            env={key: os.environ[key] for key in ("PATH", "LANG", "LC_ALL") if key in os.environ},
            input=text.encode(),
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            timeout=DEADLINE_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return ""
    return done.stdout.decode(errors="replace") if done.returncode == 0 else ""


def completed(report: dict[str, Any], job: dict[str, Any], run: Run) -> dict[str, Any]:
    """Returns a report of tests with the results of those that need Python; those without one are not run.

    Raises:
        CheckerUnavailableError: there is no answer.
    """
    left = [test for test in report["tests"] if test["outcome"] == NEEDS_PYTHON]
    if not left:
        return report
    asked = {"job": job, "run": [[test["file"], test["name"]] for test in left]}
    try:
        found = msgspec.json.decode(run(json.dumps(asked)) or "null", type=_Answer)
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
