"""`bt-studio new`: creates a project from a template."""

from __future__ import annotations

from typing import Annotated

import typer

from backend.cli.shared.stored import stored_projects


def new(
    name: Annotated[str, typer.Argument(help="Name of the new project.")],
    template: Annotated[str, typer.Option(help="Template to start from; `empty` or an example.")] = "empty",
) -> None:
    """Creates a project in the data folder."""
    with stored_projects():
        from backend.accounts.writes import local_user
        from backend.projects.documents.templates import files_of
        from backend.projects.storage.writes import create_project

        project = create_project(files_of(template), acting_user=local_user(), name=name)
        print(f"{project.id}  {project.name}")
