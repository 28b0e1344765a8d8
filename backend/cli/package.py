"""`bt-studio package`: writes a package for ROS 2 or for C++, or the app for the manager, to a zip."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from translator import Diagnostic


def package(  # noqa: PLR0913, PLR0917 - these are the options of formats.md
    project: Annotated[str, typer.Argument(help="A project folder, zip or name, or an XML file.")],
    output: Annotated[Path, typer.Option("-o", "--output", help="The zip to write.")],
    actions: Annotated[Path | None, typer.Option(help="Folder of the actions of a single tree.")] = None,
    name: Annotated[str | None, typer.Option(help="Name of the ROS package.")] = None,
    dockerized: Annotated[  # noqa: FBT002
        bool, typer.Option("--dockerized", help="Make the app that the manager runs.")
    ] = False,
    cpp: Annotated[  # noqa: FBT002
        bool, typer.Option("--cpp", help="Make a package for BehaviorTree.CPP 4, with skeletons in C++.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,  # noqa: FBT002
) -> None:
    """Makes a package that `colcon build` builds: of ROS 2, with the engine beside it, or of C++."""
    from backend.cli.shared import translation as cli
    from translator import TranslatorError, to_app_zip, to_cpp_package, to_ros2_package

    try:
        opened = cli.open_project(project, actions=actions, stubs=cpp)
        found: tuple[Diagnostic, ...] = ()
        if dockerized:
            raw, made = to_app_zip(opened), "app"
        else:
            result = (to_cpp_package if cpp else to_ros2_package)(opened, name=name)
            raw, found, made = result.to_zip(), result.diagnostics, result.name
    except TranslatorError as error:
        raise cli.fail(error.diagnostics, as_json=as_json) from None
    cli.write_file(output, raw)
    if as_json:
        diagnostics = [item.to_json() for item in found]
        cli.print_json({"file": str(output), "package": made, "size": len(raw), "diagnostics": diagnostics})
        return
    cli.tell(found)
    print(f"{output}: {made}, {len(raw)} bytes")
