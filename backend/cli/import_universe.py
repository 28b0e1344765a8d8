"""`bt-studio import-universe`: makes a universe of an SDF world, or of an occupancy map."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from executor.imports.worlds import Imported
    from tree_gardener.packages import Packages


def import_universe(
    source: Annotated[
        Path, typer.Argument(help="An SDF world, the .yaml of an occupancy map, or a folder or zip with one.")
    ],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="The .yaml to make; beside the source if not given.")
    ] = None,
    main: Annotated[str, typer.Option(help="The file of the world in the folder or zip.")] = "",
    simplify: Annotated[  # noqa: FBT002
        bool, typer.Option("--simplify", help="Make meshes of too many triangles smaller.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,  # noqa: FBT002
) -> None:
    """Imports the part of an SDF world that universes have, and lists what was left out; walls of a map.

    Models are searched around the world's file, then where GZ_SIM_RESOURCE_PATH and GAZEBO_MODEL_PATH lead.
    The meshes that it needs are copied into the folder assets/ of the project.
    """
    from backend.cli.shared import translation as cli
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from executor.universes.document import Problem
    from executor.universes.loader import UniverseError
    from executor.uploads.opened import chosen, opened
    from executor.uploads.unpacked import UploadError

    try:
        with opened(source) as (root, notes):
            file = chosen(root, "universe", main)
            is_map = file.suffix.lower() in (".yaml", ".yml")
            ending = ".universe.yaml" if is_map and file == source else ".yaml"
            target = output or source.parent / f"{file.stem}{ending}"
            if target.exists():
                raise CliError(f"{target}:1:1: it exists already (choose another name)", status=BAD_ARGUMENTS)
            made = _made(file, root, target.stem, simplify=simplify)
    except UploadError as error:
        raise CliError(f"{source}: {error}", status=BAD_ARGUMENTS) from error
    except OSError as error:
        raise CliError(f"{source}:1:1: {error.strerror or error}", status=BAD_ARGUMENTS) from error
    except UniverseError as error:
        raise CliError(*(f"{file.name}:{problem}" for problem in error.problems)) from error
    made.left_out += [Problem(f"{path}: {text}", code="BTU006") for path, text in notes]
    folder = target.parent.parent if target.parent.name == "universes" else target.parent
    for path in made.files:
        if (folder / path).exists():
            text = f"{folder / path}:1:1: it exists already (choose another name with -o)"
            raise CliError(text, status=BAD_ARGUMENTS)
    cli.write_files({folder / path: raw for path, raw in made.files.items()} | {target: made.text.encode()})
    if as_json:
        left_out = [{"line": problem.line, "message": problem.message} for problem in made.left_out]
        files_made = sorted(str(folder / path) for path in made.files)
        cli.print_json({"universe": str(target), "files": files_made, "left_out": left_out})
        return
    print(f"{target}: {made.things} thing{'' if made.things == 1 else 's'}")
    for path in sorted(made.files):
        print(f"  {folder / path}")
    if made.left_out:
        print("Left out:")
        for problem in made.left_out:
            print(f"  {file.name}:{problem.line}: {problem.message}")


def _made(file: Path, root: Path, name: str, *, simplify: bool) -> Imported:
    from executor.imports.maps import import_map
    from executor.imports.worlds import import_sdf
    from executor.sdf.files import DiskFiles

    data, files, path = file.read_bytes(), DiskFiles(_packages(file, root)), str(file.resolve())
    if file.suffix.lower() in (".yaml", ".yml"):
        return import_map(data, path, files)
    return import_sdf(data, path, files, name=name, simplify=simplify)


def _packages(source: Path, root: Path) -> Packages:
    """Returns the models around a world: those of its package, or beside its folder."""
    import os

    from tree_gardener.packages import MANIFESTS, Packages, Place, installed_places

    folder = source.resolve().parent
    above = [folder, *folder.parents]
    package = next((each for each in above if any((each / name).is_file() for name in MANIFESTS)), None)
    around = package.parent if package is not None else folder.parent if folder.name == "worlds" else folder
    if root.is_dir():
        around = root.resolve()
    places = [Place("the folder of the world", folder), Place("the folder around it", around)]
    return Packages(folder, places, installed_places(os.environ))
