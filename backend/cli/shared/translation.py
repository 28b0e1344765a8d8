"""Functions for the commands that translate: open projects and print diagnostics."""

from __future__ import annotations

import json
import sys
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from backend.cli.shared.errors import BAD_ARGUMENTS, CliError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from translator import Diagnostic, Project


def open_project(
    name: str, *, actions: Path | None = None, stubs: bool = True, repair: bool = False
) -> Project:
    """Opens a folder, a zip, a file, or the stored project with that name."""
    from translator import open_path

    path = Path(name)
    if not path.exists() and not path.suffix and (stored := _stored_files(name)) is not None:
        from translator import load

        return load(stored)
    if not path.exists():
        raise CliError(f"{name}:1:1: there is no such file, folder or project", status=BAD_ARGUMENTS)
    return open_path(path, actions=actions, stubs=stubs, repair=repair)


def _stored_files(name: str) -> Mapping[str, bytes] | None:
    """Returns the files of the stored project with this name, or None if there is none."""
    import os

    import django

    os.environ.setdefault("DJANGO_SETTINGS_MODULE", "backend.config.settings")
    django.setup()
    from django.db import DatabaseError

    from backend.accounts.writes import local_user
    from backend.core.problems import NotFoundError
    from backend.projects.storage.queries import contents, project_named

    try:
        return contents(project_named(name, user=local_user()))
    except (NotFoundError, DatabaseError):
        return None


def fail(diagnostics: Iterable[Diagnostic], *, as_json: bool) -> CliError:
    """Returns the error that ends a command because of its diagnostics."""
    found = list(diagnostics)
    if as_json:
        print_json({"diagnostics": [item.to_json() for item in found]})
        return CliError()
    return CliError(*(str(item) for item in found))


def tell(diagnostics: Iterable[Diagnostic]) -> None:
    """Prints diagnostics that do not end the command, on stderr."""
    for item in diagnostics:
        print(f"{item.severity.value}: {item}", file=sys.stderr)


def print_json(document: dict[str, Any]) -> None:
    """Prints the output of `--json`."""
    print(json.dumps(document, ensure_ascii=False, indent=2))


def write_file(path: Path, data: bytes) -> None:
    """Writes a file completely or not at all.

    Raises:
        CliError: If the file cannot be written.
    """
    temporary = path.with_name(f".{path.name}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary.write_bytes(data)
        temporary.replace(path)
    except OSError as error:
        with suppress(OSError):  # where a folder was expected, there may be a file
            temporary.unlink()
        raise CliError(f"{path}:1:1: it cannot be written: {error.strerror or error}") from error
