"""`bt-studio import-robot`: makes a robot of a project from a URDF, xacro or SDF file."""

from __future__ import annotations

import logging
import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from executor.headless.trial_drive import Trial
    from executor.robots.importing.bring import Made


def import_robot(  # noqa: PLR0913, PLR0917 - one parameter an option
    source: Annotated[
        Path, typer.Argument(help="A .urdf, .xacro or .sdf file, or a folder or zip with one.")
    ],
    into: Annotated[Path, typer.Option("--into", help="The project folder that gets the robot.")] = Path(),
    name: Annotated[
        str | None, typer.Option(help="The robot's folder below robots/; of the source's name if not given.")
    ] = None,
    main: Annotated[str, typer.Option(help="The robot's file in the folder or zip.")] = "",
    workspace: Annotated[Path | None, typer.Option(help="A folder with the packages that it names.")] = None,
    arguments: Annotated[
        list[str] | None, typer.Option("--arg", help="An argument of the macros, as name:=value.")
    ] = None,
    drive: Annotated[bool, typer.Option(help="Drive 1 m and turn by 360° to see whether it fits.")] = True,  # noqa: FBT002
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,  # noqa: FBT002
) -> None:
    """Imports a robot, and reports what was taken, assumed and left out.

    The macros of xacro run in a child that reads only the folders of the packages.
    """
    from backend.cli.shared import translation as cli
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from executor.uploads.opened import chosen, opened
    from executor.uploads.unpacked import UploadError

    logging.getLogger("executor.robots").setLevel(logging.ERROR)  # its notes are in the report
    if not source.exists():
        raise CliError(f"{source}:1:1: No such file or directory", status=BAD_ARGUMENTS)
    given = dict(_argument(text) for text in arguments or ())
    try:
        with opened(source.absolute()) as (root, notes):
            file = chosen(root, "robot", main)
            made, target = _made(file, root, into / "robots", name, workspace, given)
        made.report.left_out += [f"{path}: {text}" for path, text in notes]
        trial = _written(made, target.name, file.name, target, drive=drive)
    except UploadError as error:
        raise CliError(f"{source}: {error}", status=BAD_ARGUMENTS) from error
    except OSError as error:
        raise CliError(f"{source}:1:1: {error.strerror or error}", status=BAD_ARGUMENTS) from error
    report = made.report
    if as_json:
        driven = None
        if trial is not None:
            driven = {"way_m": trial.way_m, "turn_deg": trial.turn_deg, "fits": trial.fits}
        found = {"taken": report.taken, "assumed": report.assumed, "left_out": report.left_out}
        cli.print_json({"robot": str(target), **found, "test_drive": driven})
        return
    print(f"{target}: {made.document['name']}")
    for title, lines in (("Taken", report.taken), ("Assumed", report.assumed), ("Left out", report.left_out)):
        if lines:
            print(f"{title}:", *lines, sep="\n  ")
    if trial is not None:
        print(f"Test drive: {trial}" + ("" if trial.fits else ": this does not fit; see robot.yaml"))


def _made(  # noqa: PLR0913, PLR0917 - one parameter an option
    file: Path,
    root: Path,
    robots: Path,
    name: str | None,
    workspace: Path | None,
    arguments: dict[str, str],
) -> tuple[Made, Path]:
    """Returns a robot, and the folder that it gets."""
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from executor.robots.importing.bring import folder_name, make_robot, places_of
    from executor.robots.importing.wheels import NoDriveError
    from executor.universes.document import DocumentError

    robot = name or folder_name(file)
    if not re.fullmatch(r"[A-Za-z0-9_-]{1,60}", robot):
        raise CliError(f"{robot!r} is no name of a folder: letters, digits, _ and -", status=BAD_ARGUMENTS)
    target = robots / robot
    if target.exists():
        raise CliError(f"{target}:1:1: it exists already (choose another --name)", status=BAD_ARGUMENTS)
    places = places_of(file, root, workspace and workspace.absolute())
    try:
        return make_robot(file, robot, places, arguments), target
    except DocumentError as error:
        raise CliError(*str(error).splitlines()) from error
    except NoDriveError as error:
        raise CliError(f"{file.name}:1:1: the robot cannot be imported: {error}") from error


def _written(made: Made, robot: str, source: str, target: Path, *, drive: bool) -> Trial | None:
    """Drives the robot in a temporary project, then writes it completely or not at all."""
    import tempfile

    from backend.cli.shared import translation as cli
    from executor.headless.trial_drive import fit

    with tempfile.TemporaryDirectory(prefix="bt-studio-robot-") as folder:
        trial = fit(made, robot, source, Path(folder)) if drive else None
    cli.write_files({target / path: data for path, data in made.written(source).items()})
    return trial


def _argument(text: str) -> tuple[str, str]:
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError

    name, separator, value = text.partition(":=")
    if not separator or not name:
        raise CliError(f"{text!r} is no argument: write name:=value", status=BAD_ARGUMENTS)
    return name, value
