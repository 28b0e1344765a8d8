"""`bt-studio check`: prints every diagnostic that the editor shows."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from translator import Project
    from translator.diagnostic import Diagnostic


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
    from backend.cli.shared.robots import check_robots
    from backend.workers.behaviours import problems_of_tests
    from executor.headless.inspection import launch_notes, problems_of
    from translator import TranslatorError, inspect_action
    from translator import check as check_project
    from translator.archive import read_file
    from translator.check.sources import source_findings
    from translator.package.naming import maintainer_problems

    opened: Project | None = None
    checked: tuple[Diagnostic, ...] | None = None
    try:
        if project.endswith(".py"):
            source = read_file(Path(project)).decode("utf-8", "replace")
            found = source_findings(inspect_action(source, project), _neighbours(Path(project)))
        else:
            opened = cli.open_project(project, actions=actions)
            checked = check_project(opened)
            found = (*checked, *maintainer_problems(opened.settings))
    except TranslatorError as error:
        found = error.diagnostics
    errors = sum(item.is_error for item in found)
    robots, notes = ([], []) if opened is None else check_robots(opened.files)
    parts = [] if opened is None else [line for line in problems_of(opened) if line not in robots]
    notes += [] if opened is None else launch_notes(opened.files)
    tests = [] if opened is None else problems_of_tests(opened, checked)
    evaluations = [] if opened is None else _wrong_evaluations(opened, [*robots, *parts], errors=errors)
    if as_json:
        cli.print_json(
            {
                "diagnostics": [item.to_json() for item in found],
                "evaluations": evaluations,
                "tests": [item.to_json() for item in tests],
                "robots": robots,
                "parts": parts,
                "notes": notes,
            }
        )
    else:
        cli.tell(item for item in found if not item.is_error)
        for note in notes:
            sys.stderr.write(f"{note}\n")
    wrong = [*robots, *parts, *map(str, tests), *evaluations]
    if errors or wrong:
        lines = [*(str(item) for item in found if item.is_error), *wrong]
        raise CliError(*([] if as_json else lines))
    if not as_json:
        warnings = sum(item.severity.value == "warning" for item in found) + len(notes)
        print(f"{project}: no errors" + (f", {warnings} warnings" if warnings else ""))


def _neighbours(action: Path) -> dict[str, bytes]:
    """Returns the Python that an action can import, as files of a project."""
    folder = action.resolve().parent
    root = folder.parent
    found = {f"actions/{path.name}": path.read_bytes() for path in folder.glob("*.py") if path.is_file()}
    if folder.name != "actions" or not (root / "project.json").is_file():
        return found
    others = {
        path.relative_to(root).as_posix(): b"" for path in (*root.glob("*.py"), *root.glob("*/**/*.py"))
    }
    requirements = root / "requirements.txt"
    listed = {"requirements.txt": requirements.read_bytes()} if requirements.is_file() else {}
    return {**others, **found, **listed}


def _wrong_evaluations(project: Project, known: list[str], *, errors: int) -> list[str]:
    """Returns the errors of a project's evaluations, each with its file and line.

    Args:
        project: the project.
        known: the errors of its robots, universes and launch files, which are not told again.
        errors: the number of errors of its trees; with any, only the form of the evaluations is looked at.
    """
    if not any(path.startswith("evaluations/") for path in project.files):
        return []
    from executor.evaluation.plan import EvaluationError, evaluation_names, make_plan, read_evaluation
    from executor.universes.document import DocumentError
    from translator import TranslatorError

    read = read_evaluation if errors else make_plan
    found: list[str] = []
    for name in evaluation_names(project):
        try:
            read(project, name)
        except (DocumentError, EvaluationError) as error:
            found += str(error).splitlines()
        except TranslatorError as error:
            found += map(str, error.diagnostics)
    return [line for line in dict.fromkeys(found) if line not in known]
