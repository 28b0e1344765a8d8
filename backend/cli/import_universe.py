"""`bt-studio import-universe`: makes a universe of an SDF world."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import Annotated

import typer


def import_universe(
    source: Annotated[Path, typer.Argument(help="An SDF world.")],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="The .yaml to make; beside the source if not given.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,  # noqa: FBT002
) -> None:
    """Imports the part of an SDF world that universes have, and lists what was left out."""
    from backend.cli.shared import translation as cli
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from executor.universes.loader import UniverseError
    from executor.universes.sdf import import_sdf

    target = output or source.with_suffix(".yaml")
    if target.exists():
        raise CliError(f"{target}:1:1: it exists already (choose another name)", status=BAD_ARGUMENTS)
    try:
        made = import_sdf(source.read_bytes(), source.name)
    except OSError as error:
        raise CliError(f"{source}:1:1: {error.strerror}", status=BAD_ARGUMENTS) from error
    except UniverseError as error:
        raise CliError(*(f"{source.name}:{problem}" for problem in error.problems)) from error
    cli.write_file(target, made.text.encode())
    if as_json:
        left_out = [{"line": problem.line, "message": problem.message} for problem in made.left_out]
        cli.print_json({"universe": str(target), "left_out": left_out})
        return
    print(f"{target}: {made.text.count('{id:')} things")
    if made.left_out:
        print("Left out:")
        for problem in made.left_out:
            print(f"  {source.name}:{problem.line}: {problem.message}")
