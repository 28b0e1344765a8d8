"""One run of an evaluation: `bt-studio run PROJECT --evaluation NAME --seed N`."""

from __future__ import annotations

import dataclasses
import json
import sys
from typing import TYPE_CHECKING

from executor.supervision.single_threaded import SINGLE_THREADED

if TYPE_CHECKING:
    from collections.abc import Iterator
    from contextlib import AbstractContextManager
    from pathlib import Path

    from executor.evaluation.outcome import Outcome
    from executor.evaluation.plan import Plan


def run_one(  # noqa: PLR0913 - one an option
    project: str,
    name: str,
    seed: int,
    *,
    judged_by: str | None,
    record: Path | None,
    report: Path | None,
    as_json: bool,
) -> None:
    """Runs one seed, prints its outcome, and fails unless it is a success."""
    from backend.cli.run import fix_hashes, say_left_out
    from backend.cli.shared import translation as cli
    from backend.cli.shared.errors import CliError

    fix_hashes(SINGLE_THREADED)
    plan = open_plan(project, name, judged_by=judged_by, as_json=as_json)
    say_left_out(plan.project)
    outcome = _run(plan, seed, record)
    document = outcome.to_line() + "\n"
    if report is not None:
        cli.write_file(report, document.encode())
    if as_json:
        sys.stdout.write(document)
    else:
        for line in outcome_lines(outcome):
            print(line)
    if not outcome.is_success:
        raise CliError()


def evaluations_of(project: str) -> list[str]:
    """Returns the names of a project's evaluations.

    Raises:
        CliError: the project cannot be read.
    """
    from backend.cli.shared import translation as cli

    with explained():
        from executor.evaluation.plan import evaluation_names

        return evaluation_names(cli.open_project(project))


def open_plan(project: str, name: str, *, judged_by: str | None = None, as_json: bool = False) -> Plan:
    """Reads and checks an evaluation of a project.

    Args:
        project: the project.
        name: the evaluation.
        judged_by: the project whose evaluations, universes and robots count; without it, the project itself.
        as_json: whether errors are written as JSON.

    Raises:
        CliError: it cannot be run; each line has a place.
    """
    from backend.cli.shared import translation as cli

    with explained(as_json=as_json):
        from executor.evaluation.plan import make_plan

        opened = cli.open_project(project)
        if judged_by is None:
            return make_plan(opened, name)
        from backend.cli.evaluating.against import load_in_worlds_of

        plan = make_plan(cli.open_project(judged_by), name)
        judged = plan.with_project(load_in_worlds_of(plan.project, opened.files))
        return dataclasses.replace(judged, judged_by=judged_by)


def explained(*, as_json: bool = False) -> AbstractContextManager[None]:
    """Turns errors of projects, evaluations, universes and robots into those of the command line."""
    from contextlib import contextmanager

    from backend.cli.shared import translation as cli
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from executor.evaluation.plan import EvaluationError
    from executor.headless.errors import HeadlessError
    from executor.universes.document import DocumentError
    from translator import TranslatorError

    @contextmanager
    def guard() -> Iterator[None]:
        try:
            yield
        except TranslatorError as error:
            raise cli.fail(error.diagnostics, as_json=as_json) from error
        except (DocumentError, EvaluationError) as error:
            raise CliError(str(error), status=BAD_ARGUMENTS) from error
        except HeadlessError as error:
            raise CliError(str(error)) from error

    return guard()


def _run(plan: Plan, seed: int, record: Path | None) -> Outcome:
    from backend.cli.shared.errors import CliError
    from backend.cli.shared.progress import show_progress
    from executor.evaluation.run import run_cell
    from executor.headless.guard import Guard, Hung

    def progress(time_s: float) -> None:
        show_progress(f"{time_s:6.1f} s of {plan.evaluation.duration_s:g} s")

    try:
        with explained(), Guard() as guard:
            return run_cell(
                plan, seed, recording=record, moved=guard.moved, progress=progress, say=_say_on_stderr
            )
    except Hung as hung:
        raise CliError(str(hung)) from None
    finally:
        show_progress("")


def _say_on_stderr(line: str) -> None:
    sys.stderr.write(f"{line}\n")


def outcome_lines(outcome: Outcome) -> Iterator[str]:
    """Yields the lines that the terminal shows for a run."""
    yield f"{outcome.outcome} after {outcome.end_s:.2f} s with seed {outcome.seed}: {outcome.why}"
    for item in outcome.items:
        margin = "" if item["margin"] is None else f" by {abs(item['margin']):.3g} {item['unit']}".rstrip()
        at = "" if item["at_s"] is None else f" at {item['at_s']:.2f} s"
        yield f"    {'holds' if item['holds'] else 'FAILS'}  {item['item']}{at}{margin}"
    for name, value in outcome.measures.items():
        yield f"    {name} = {value:g}"
    for name, value in outcome.drawn.items():
        yield f"    drawn  {name} = {json.dumps(value)}"
