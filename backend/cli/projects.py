"""`bt-studio projects`: lists the stored projects."""

from __future__ import annotations

import json
from typing import Annotated

import typer

from backend.cli.shared.stored import stored_projects


def projects(
    search: Annotated[str, typer.Argument(help="Words that name or description contain.")] = "",
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,  # noqa: FBT002
) -> None:
    """Lists the stored projects, the newest first."""
    with stored_projects():
        from backend.accounts.writes import local_user
        from backend.projects.api.presentation import summary
        from backend.projects.storage.queries import projects as find

        rows = list(find(user=local_user(), search=search))
        if as_json:
            print(json.dumps([summary(row, None, []) for row in rows], ensure_ascii=False, indent=2))
            return
        for row in rows:
            print(f"{row.id}  {row.updated_at:%Y-%m-%d %H:%M}  {row.name}")
