"""`bt-studio import`: makes a project of trees and projects of other programs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import typer

if TYPE_CHECKING:
    from translator import Project

OF_THE_FOUND_ONE: Final = frozenset({"BT0749", "BT0750"})
"""Notes about the ROS distribution that an import found, where the user names another."""
ONLY_DOCUMENTS: Final = "--actions, --repair and --order are not for a Python file."


def import_(  # noqa: PLR0913, PLR0917 - these are the options of formats.md
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
    ros_distro: Annotated[
        str,
        typer.Option(help="The ROS distribution of the robot in place of the one that is found: jazzy …"),
    ] = "",
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,  # noqa: FBT002
) -> None:
    """Imports BehaviorTree.CPP XML (v3, v4), Groot2's and JdeRobot's projects, Python files with py_trees."""
    from backend.cli.shared import translation as cli
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from backend.cli.shared.py_trees_import import py_trees_project
    from translator import TranslatorError
    from translator.jderobot.project import ORDERS
    from translator.nav2.distributions import DISTRIBUTIONS
    from translator.package.zip import write_zip

    if (output is None) == (into is None):
        raise CliError("Name either the project to make (-o), or a folder (--into).", status=BAD_ARGUMENTS)
    if order not in {"", *ORDERS}:
        raise CliError(f"--order is {' or '.join(ORDERS)}.", status=BAD_ARGUMENTS)
    if ros_distro not in {"", *DISTRIBUTIONS}:
        raise CliError(f"--ros-distro is {', '.join(DISTRIBUTIONS)}.", status=BAD_ARGUMENTS)
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
    project, lacks = _for_distribution(project, ros_distro)
    if is_zip:
        cli.write_file(output, write_zip(project.files))
    else:
        for path, raw in project.files.items():
            cli.write_file(output / path, raw)
    _tell(output, project, lacks, as_json=as_json)


def _for_distribution(project: Project, name: str) -> tuple[Project, list[str]]:
    """Returns the project for a ROS distribution, if one is named, and the names of what that lacks."""
    from translator import load
    from translator.nav2.change import changed
    from translator.nav2.distributions import DISTRIBUTIONS

    distribution = next((each for each in DISTRIBUTIONS if each == name), None)
    if distribution is None:
        return project, []
    change = changed(project.files, distribution)
    files = {**project.files, **change.files}
    made = load({path: raw for path, raw in files.items() if raw is not None})
    notes = tuple(found for found in project.diagnostics if found.code not in OF_THE_FOUND_ONE)
    return replace(made, diagnostics=notes), [str(lack) for lack in change.lacks]


def _tell(output: Path, project: Project, lacks: list[str], *, as_json: bool) -> None:
    from backend.cli.shared import translation as cli
    from translator.nav2.distributions import titled
    from translator.nav2.models import distribution_for
    from tree_gardener.stubs import is_stub

    stubs = sorted(name for name, action in project.actions.items() if is_stub(action.source))
    if as_json:
        cli.print_json(
            {
                "project": str(output),
                "trees": sorted(project.trees),
                "actions": sorted(project.actions),
                "to_be_written": stubs,
                "universe": project.settings.universe,
                "ros_distro": distribution_for(project),
                "lacks": lacks,
                "diagnostics": [item.to_json() for item in project.diagnostics],
            }
        )
        return
    cli.tell(project.diagnostics)
    print(f"{output}: {_counted(len(project.trees), 'tree')}, {_counted(len(project.actions), 'action')}")
    print(f"Universe: {project.settings.universe}")
    print(f"ROS distribution: {titled(distribution_for(project))}")
    if lacks:
        print(f"Not in its Nav2: {', '.join(lacks)}")
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
