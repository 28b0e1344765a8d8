"""`bt-studio check`: prints every diagnostic that the editor shows."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from translator import Project


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

    opened: Project | None = None
    try:
        if project.endswith(".py"):
            source = read_file(Path(project)).decode("utf-8", "replace")
            found = inspect_action(source, project).diagnostics
        else:
            opened = cli.open_project(project, actions=actions)
            found = check_project(opened)
    except TranslatorError as error:
        found = error.diagnostics
    errors = sum(item.is_error for item in found)
    wrong = [] if opened is None or errors else _wrong_evaluations(opened)
    if as_json:
        cli.print_json({"diagnostics": [item.to_json() for item in found], "evaluations": wrong})
    if not as_json:
        cli.tell(item for item in found if not item.is_error)
    if errors or wrong:
        lines = [*(str(item) for item in found if item.is_error), *wrong]
        raise CliError(*([] if as_json else lines))
    if not as_json:
        warnings = sum(item.severity.value == "warning" for item in found)
        print(f"{project}: no errors" + (f", {warnings} warnings" if warnings else ""))


def _wrong_evaluations(project: Project) -> list[str]:
    """Returns the errors of a project's evaluations, each with its file and line."""
    if not any(path.startswith("evaluations/") for path in project.files):
        return []
    from executor.evaluation.plan import EvaluationError, evaluation_names, make_plan
    from executor.universes.document import DocumentError
    from translator import TranslatorError

    found: list[str] = []
    for name in evaluation_names(project):
        try:
            make_plan(project, name)
        except (DocumentError, EvaluationError) as error:
            found += str(error).splitlines()
        except TranslatorError as error:
            found += map(str, error.diagnostics)
    return found
