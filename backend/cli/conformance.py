"""`bt-studio conformance`: runs the engine on cases with the traces of BehaviorTree.CPP."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path  # noqa: TC003 - typer reads it at run time
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from collections import Counter
    from collections.abc import Mapping

    from tree_gardener.conformance import Deviation

SHOWN = 5


def conformance(
    cases: Annotated[list[Path], typer.Argument(help="Files of cases: JSON lines, or the script table.")],
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object a case.")] = False,  # noqa: FBT002
    deviations: Annotated[
        Path | None,
        typer.Option(
            help="Your own reasons: a JSON object, by name, of `kind`, `reason` and `cases` (patterns)."
        ),
    ] = None,
) -> None:
    """Runs engine conformance cases; prints the first differences, and last how many passed and failed.

    A case that differs for a known reason is not a failure; these are listed with their reasons.
    """
    from collections import Counter

    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError

    missing = [path for path in (*cases, deviations) if path is not None and not path.is_file()]
    if missing:
        lines = [f"{path}: CL001 there is no such file" for path in missing]
        raise CliError(*lines, status=BAD_ARGUMENTS)
    from tree_gardener.conformance import DEVIATIONS, read_deviations, report

    try:
        own = {} if deviations is None else read_deviations(deviations)
    except ValueError as error:
        raise CliError(
            f"{deviations}: CL002 these are no deviations: {error}", status=BAD_ARGUMENTS
        ) from None
    counts: Counter[str] = Counter()
    for path in cases:
        counts += _run(path, own, as_json=as_json, shown=counts["failed"])
    failed = counts["failed"]
    if not as_json:
        print(f"{counts['passed']} passed, {failed} failed")
        for line in report(counts, {**DEVIATIONS, **own}):
            print(line)
    if failed:
        raise CliError()


def _run(path: Path, own: Mapping[str, Deviation], *, as_json: bool, shown: int) -> Counter[str]:
    """Runs one file; returns the numbers of passed cases, of failed cases, and of each deviation."""
    import json
    from collections import Counter

    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from tree_gardener.conformance import run_file

    counts: Counter[str] = Counter()
    try:
        for outcome in run_file(path, own):
            if as_json:
                print(json.dumps(asdict(outcome)))
            counts["passed" if outcome.passed else outcome.deviation or "failed"] += 1
            if outcome.failed and shown + counts["failed"] <= SHOWN and not as_json:
                print(f"{path}: {outcome.name}")
                for difference in outcome.differences[:SHOWN]:
                    print(f"    {difference}")
    except (ValueError, KeyError, TypeError) as error:
        line = f"{path}: CL002 this is no file of cases: {type(error).__name__}: {error}"
        raise CliError(line, status=BAD_ARGUMENTS) from None
    return counts
