"""`bt-studio check`: prints every diagnostic that the editor shows."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def check(
    project: Annotated[
        str, typer.Argument(help="A project folder, zip or name, or a .json, .xml or .py file.")
    ],
    actions: Annotated[Path | None, typer.Option(help="Folder of the actions of a single tree.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the findings as JSON.")] = False,  # noqa: FBT002
) -> None:
    """Checks a project, a tree or an action; exit status 1 if something keeps it from running."""
    from backend.cli.shared import translation as cli
    from backend.cli.shared.errors import CliError
    from translator import TranslatorError, inspect_action
    from translator import check as check_project
    from translator.archive import read_file

    try:
        if project.endswith(".py"):
            source = read_file(Path(project)).decode("utf-8", "replace")
            found = inspect_action(source, project).diagnostics
        else:
            found = check_project(cli.open_project(project, actions=actions))
    except TranslatorError as error:
        found = error.diagnostics
    if as_json:
        cli.print_json({"diagnostics": [item.to_json() for item in found]})
    errors = sum(item.is_error for item in found)
    if not as_json:
        cli.tell(item for item in found if not item.is_error)
    if errors:
        raise CliError(*([] if as_json else [str(item) for item in found if item.is_error]))
    if not as_json:
        warnings = sum(item.severity.value == "warning" for item in found)
        print(f"{project}: no errors" + (f", {warnings} warnings" if warnings else ""))
