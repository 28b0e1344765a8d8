"""Functions for the commands that translate: open projects and print diagnostics."""

from __future__ import annotations

import json
import sys
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from backend.cli.shared.errors import BAD_ARGUMENTS, CliError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from translator import Diagnostic, Project


def open_project(  # noqa: PLR0913 - each is a separate choice, and keyword-only
    name: str,
    *,
    actions: Path | None = None,
    stubs: bool = True,
    repair: bool = False,
    main: str = "",
    order: str = "",
) -> Project:
    """Opens a folder, a zip, a file, or the stored project with that name."""
    from translator import open_path

    path = Path(name)
    if not path.exists() and not path.suffix and (stored := _stored_files(name)) is not None:
        from translator import load

        return load(stored)
    if not path.exists():
        raise CliError(f"{name}:1:1: there is no such file, folder or project", status=BAD_ARGUMENTS)
    return open_path(path, actions=actions, stubs=stubs, repair=repair, main=main, order=order)


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
    write_files({path: data})


def write_files(files: Mapping[Path, bytes]) -> None:
    """Writes files, all of them completely or none of the new ones; no folder is left that was made for them.

    Raises:
        CliError: one of them cannot be written.
    """
    made: list[Path] = []
    path = Path()
    try:
        for path, data in files.items():
            make_folders(path.parent, made)
            made.append(_part(path))
            _part(path).write_bytes(data)
        for path in files:
            made += [] if path.exists() else [path]
            _part(path).replace(path)
    except BaseException as error:
        remove_made(made)
        if not isinstance(error, OSError):
            raise
        raise CliError(f"{path}:1:1: it cannot be written: {error.strerror or error}") from error


def make_folders(folder: Path, made: list[Path]) -> None:
    """Makes a folder and those above it, and adds the new ones to a list."""
    if folder.exists():
        return
    make_folders(folder.parent, made)
    folder.mkdir()
    made.append(folder)


def remove_made(made: Sequence[Path]) -> None:
    """Removes files and empty folders, the last one first; what others put there stays."""
    for path in reversed(made):
        with suppress(OSError):
            path.rmdir() if path.is_dir() else path.unlink()


def _part(path: Path) -> Path:
    return path.with_name(f".{path.name}.part")
