"""`bt-studio import`: makes a project of trees and projects of other programs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer

ONLY_DOCUMENTS: Final = "--actions, --repair and --order are not for a Python file."


def import_(  # noqa: PLR0912, PLR0913, PLR0917 - these are the options of formats.md
    source: Annotated[str, typer.Argument(help="An XML file, a .btproj, a .py, a folder or a zip.")],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="The project folder or .zip to make.")
    ] = None,
    into: Annotated[
        Path | None, typer.Option(help="A project folder that takes over the models of nodes in the file.")
    ] = None,
    actions: Annotated[Path | None, typer.Option(help="Folder of actions to bring along.")] = None,
    repair: Annotated[  # noqa: FBT002 - typer's way
        bool, typer.Option("--repair", help="Escape bare & and < in attributes, which XML does not allow.")
    ] = False,
    main: Annotated[
        str,
        typer.Option(help="The main tree, or the file, variable or function with it."),
    ] = "",
    order: Annotated[
        str,
        typer.Option(
            help="The order of children on JdeRobot's canvas in place of the project's: bottom-to-top or "
            "top-to-bottom."
        ),
    ] = "",
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,  # noqa: FBT002
) -> None:
    """Imports BehaviorTree.CPP XML (v3, v4), Groot2's and JdeRobot's projects, Python files with py_trees."""
    from backend.cli.shared import translation as cli
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from backend.cli.shared.py_trees_import import py_trees_project
    from translator import TranslatorError
    from translator.jderobot.project import ORDERS
    from translator.package.zip import write_zip
    from tree_gardener.stubs import is_stub

    if (output is None) == (into is None):
        raise CliError("Name either the project to make (-o), or a folder (--into).", status=BAD_ARGUMENTS)
    if order not in {"", *ORDERS}:
        raise CliError(f"--order is {' or '.join(ORDERS)}.", status=BAD_ARGUMENTS)
    if output is None:
        assert into is not None  # noqa: S101 - one of them is given
        _take_over(Path(source), into, as_json=as_json)
        return
    is_zip = output.suffix.lower() == ".zip"
    if output.exists() and (is_zip or not output.is_dir() or any(output.iterdir())):
        raise CliError(f"{output}:1:1: it exists already (choose another name)", status=BAD_ARGUMENTS)
    try:
        if source.endswith(".py"):
            if actions or repair or order:
                raise CliError(ONLY_DOCUMENTS, status=BAD_ARGUMENTS)
            project = py_trees_project(Path(source), main)
        else:
            project = cli.open_project(source, actions=actions, repair=repair, main=main, order=order)
    except TranslatorError as error:
        raise cli.fail(error.diagnostics, as_json=as_json) from None
    if is_zip:
        cli.write_file(output, write_zip(project.files))
    else:
        for path, raw in project.files.items():
            cli.write_file(output / path, raw)
    stubs = sorted(name for name, action in project.actions.items() if is_stub(action.source))
    if as_json:
        cli.print_json(
            {
                "project": str(output),
                "trees": sorted(project.trees),
                "actions": sorted(project.actions),
                "to_be_written": stubs,
                "universe": project.settings.universe,
                "diagnostics": [item.to_json() for item in project.diagnostics],
            }
        )
        return
    cli.tell(project.diagnostics)
    print(f"{output}: {_counted(len(project.trees), 'tree')}, {_counted(len(project.actions), 'action')}")
    print(f"Universe: {project.settings.universe}")
    if stubs:
        print(f"To be written: {', '.join(f'actions/{name}.py' for name in stubs)}")


def _take_over(source: Path, folder: Path, *, as_json: bool) -> None:
    """Writes stubs for the nodes of a plugin or palette, and lists the differences from existing actions."""
    from backend.cli.shared import translation as cli
    from translator import TranslatorError, take_over
    from translator.archive import read_file

    try:
        project = cli.open_project(str(folder))
        result = take_over(project, read_file(source), file=source.name)
    except TranslatorError as error:
        raise cli.fail(error.diagnostics, as_json=as_json) from None
    for path, raw in result.files.items():
        cli.write_file(folder / path, raw)
    if as_json:
        diagnostics = [item.to_json() for item in result.diagnostics]
        cli.print_json({"project": str(folder), "written": sorted(result.files), "diagnostics": diagnostics})
        return
    cli.tell(result.diagnostics)
    print(f"{folder}: {_counted(len(result.files), 'stub')} written")


def _counted(count: int, what: str) -> str:
    return f"{count} {what}" if count == 1 else f"{count} {what}s"
