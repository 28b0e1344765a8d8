"""`bt-studio conformance`: runs the engine on cases with the traces of BehaviorTree.CPP."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - typer reads it at run time
from typing import Annotated

import typer

SHOWN = 5


def conformance(
    cases: Annotated[list[Path], typer.Argument(help="Files of cases: JSON lines, or the script table.")],
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object a case.")] = False,  # noqa: FBT002
) -> None:
    """Runs engine conformance cases; prints the first differences, and last how many passed and failed."""
    from backend.cli.errors import BAD_ARGUMENTS, CliError

    missing = [path for path in cases if not path.is_file()]
    if missing:
        lines = [f"{path}: CL001 there is no such file" for path in missing]
        raise CliError(*lines, status=BAD_ARGUMENTS)
    passed = failed = 0
    for path in cases:
        good, bad = _run(path, as_json=as_json, shown=failed)
        passed += good
        failed += bad
    if not as_json:
        print(f"{passed} passed, {failed} failed")
    if failed:
        raise CliError()


def _run(path: Path, *, as_json: bool, shown: int) -> tuple[int, int]:
    """Runs one file; gives how many cases passed and failed."""
    import json

    from backend.cli.errors import BAD_ARGUMENTS, CliError
    from tree_gardener.conformance import run_file

    passed = failed = 0
    try:
        for outcome in run_file(path):
            if as_json:
                print(json.dumps({"name": outcome.name, "differences": outcome.differences}))
            passed += outcome.passed
            failed += not outcome.passed
            if not outcome.passed and shown + failed <= SHOWN and not as_json:
                print(f"{path}: {outcome.name}")
                for difference in outcome.differences[:SHOWN]:
                    print(f"    {difference}")
    except (ValueError, KeyError, TypeError) as error:
        line = f"{path}: CL002 this is no file of cases: {type(error).__name__}: {error}"
        raise CliError(line, status=BAD_ARGUMENTS) from None
    return passed, failed
