"""`bt-studio export`: writes a stored project to a zip."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from backend.cli.shared.stored import find_project, stored_projects


def export(
    project: Annotated[str, typer.Argument(help="Name or id of a stored project.")],
    output: Annotated[Path | None, typer.Option("--output", "-o", help="The zip to write.")] = None,
) -> None:
    """Writes the current files of a stored project to a zip."""
    with stored_projects():
        from backend.projects.storage.queries import contents
        from backend.workers.zips import pack

        found = find_project(project)
        target = output or Path(f"{found.name}.zip")
        target.write_bytes(pack(contents(found)))
        print(target)
