"""`bt-studio test`: runs the behaviour tests of a project, without a robot and without a world."""

from __future__ import annotations

import json
import re
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated, Any
from xml.etree import ElementTree as ET

import typer

if TYPE_CHECKING:
    from collections.abc import Sequence

    from translator import Project
    from tree_gardener.errors import Diagnostic
    from tree_gardener.testing import Case, Coverage, Result

_MISSING_SHOWN = 10
_NO_XML = re.compile(r"[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def run_tests(
    project: Annotated[str, typer.Argument(help="A project folder, zip or name.")],
    name: Annotated[str, typer.Option("-k", help="Only tests whose name contains this.")] = "",
    junit: Annotated[Path | None, typer.Option(help="File for the results, as JUnit's XML.")] = None,
    coverage: Annotated[
        Path | None, typer.Option(help="File for the coverage of the trees, as JSON.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the results as JSON.")] = False,  # noqa: FBT002
) -> None:
    """Runs the behaviour tests of a project, the files tests/*.test.yaml; exit status 1 if one fails."""
    from backend.cli.run import say_left_out
    from backend.cli.shared import translation as cli
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from translator import TranslatorError
    from translator.behaviour_tests import errors_before_tests, to_job
    from tree_gardener.testing.apart import run_apart
    from tree_gardener.testing.job import Job

    try:
        opened = cli.open_project(project)
        errors = errors_before_tests(opened)
        if errors:
            raise TranslatorError(errors)
    except TranslatorError as error:
        raise cli.fail(error.diagnostics, as_json=as_json) from error
    document, problems = to_job(opened, real=True)
    job = Job.from_json(document)
    suite = job.suite()
    cases, wrong = job.cases(suite)
    problems += wrong
    chosen = [case for case in cases if name in case.name]
    if not chosen and not problems:
        what = (
            f"no test has {name!r} in its name" if cases else "there are no tests; write tests/main.test.yaml"
        )
        raise CliError(f"{project}:1:1: {what}", status=BAD_ARGUMENTS)
    say_left_out(opened)
    results = run_apart(job, chosen, told=None if as_json else _say)
    reached = suite.coverage(_roots(opened, chosen))
    for result in results:
        reached.add_seen(result.seen)
    if junit is not None:
        cli.write_file(junit, junit_xml(results, problems))
    if coverage is not None:
        text = json.dumps(coverage_document(reached, results), ensure_ascii=False, indent=2)
        cli.write_file(coverage, f"{text}\n".encode())
    failed = sum(not result.passed for result in results)
    if as_json:
        cli.print_json(results_document(results, problems, reached))
    else:
        print(_summary(results, failed, reached))
    if failed or problems:
        raise CliError(*([] if as_json else map(str, problems)))


def _roots(project: Project, cases: Sequence[Case]) -> list[str]:
    """Returns the trees to cover: those of the tests, and those that the project's main tree calls."""
    from translator.tree import reachable_trees

    main = project.settings.main_tree
    tested = [case.tree or main for case in cases]
    return list(dict.fromkeys([*tested, *reachable_trees(project.trees, main)]))


def _say(result: Result) -> None:
    print(f"{'passed' if result.passed else 'FAILED'}  {result.file}:{result.line}: {result.name}")
    for failure in result.failures:
        print(f"    {result.file}:{failure.line}: {failure}")
        if failure.path:
            print("        " + " > ".join(f"{node} {status}" for node, status in failure.path))


def _summary(results: Sequence[Result], failed: int, reached: Coverage) -> str:
    ticks = sum(result.ticks for result in results)
    seconds = sum(result.duration_s for result in results)
    text = f"{len(results) - failed} passed, {failed} failed, {ticks} ticks in {seconds:.2f} s"
    missing = reached.missing()
    text += f"; {reached.share:.0%} of the trees covered"
    for tree, node, item in missing[:_MISSING_SHOWN]:
        called = reached.names[tree, node][0]
        text += f"\n    not covered: {tree} {node} '{called}': {item}"
    left = len(missing) - _MISSING_SHOWN
    return f"{text}\n    and {left} more" if left > 0 else text


def results_document(
    results: Sequence[Result], problems: Sequence[Diagnostic], reached: Coverage
) -> dict[str, Any]:
    """Returns the document that `--json` prints."""
    return {
        "format": "bt-studio/test-results",
        "version": 1,
        "passed": sum(result.passed for result in results),
        "failed": sum(not result.passed for result in results),
        "coverage": round(reached.share, 6),
        "problems": [problem.to_json() for problem in problems],
        "tests": [result.to_json() for result in results],
    }


def coverage_document(reached: Coverage, results: Sequence[Result]) -> dict[str, Any]:
    """Returns the coverage of all tests, and the items that each test reached."""
    return {
        **reached.to_json(),
        "tests": [{"file": result.file, "name": result.name, "reached": result.seen} for result in results],
    }


def junit_xml(results: Sequence[Result], problems: Sequence[Diagnostic]) -> bytes:
    """Returns the results as JUnit's XML; a file that cannot be read is an error."""
    failed = sum(not result.passed for result in results)
    root = ET.Element("testsuites")
    counts: Any = {
        "tests": str(len(results) + len(problems)),
        "failures": str(failed),
        "errors": str(len(problems)),
    }
    seconds = sum(result.duration_s for result in results)
    suite = ET.SubElement(root, "testsuite", name="bt-studio", time=f"{seconds:.6f}", **counts)
    for result in results:
        case = ET.SubElement(
            suite,
            "testcase",
            name=xml_text(result.name),
            classname=xml_text(result.file),
            file=xml_text(result.file),
            line=str(result.line),
            time=f"{result.duration_s:.6f}",
        )
        for failure in result.failures:
            told = ET.SubElement(case, "failure", message=xml_text(str(failure)))
            told.text = xml_text("\n".join(f"{node} {status}" for node, status in failure.path))
    for problem in problems:
        case = ET.SubElement(suite, "testcase", name=problem.code, classname=xml_text(problem.file))
        ET.SubElement(case, "error", message=xml_text(str(problem)))
    written: bytes = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    return written


def xml_text(text: str) -> str:
    """Replaces characters that XML cannot hold."""
    return _NO_XML.sub("\ufffd", text)
