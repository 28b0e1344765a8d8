"""`bt-studio backup` and `bt-studio restore`: copy all data of a server to and from one file."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from collections.abc import Iterator  # noqa: TC003
from contextlib import contextmanager
from pathlib import Path  # noqa: TC003 - read at run time
from typing import IO, Annotated

import typer

from backend.cli.shared.errors import CliError
from backend.cli.shared.progress import show_progress
from backend.cli.shared.stored import stored_projects


def backup(
    output: Annotated[Path, typer.Argument(help="The zip to write; - writes to the standard output.")],
    without_objects: Annotated[  # noqa: FBT002
        bool, typer.Option("--without-objects", help="Leave out what is in the object store.")
    ] = False,
) -> None:
    """Writes all accounts, projects and revisions to one file; the server may keep running.

    What is in the object store (BT_STUDIO_OBJECT_STORE) is copied, too, unless --without-objects says that
    the bucket has a backup of its own.
    """
    with stored_projects(), _explained():
        if str(output) == "-":
            counts = _write(sys.stdout.buffer, without_objects)
        else:
            partial = output.with_name(output.name + ".partial")
            descriptor = os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
            try:
                with os.fdopen(descriptor, "wb") as file:
                    counts = _write(file, without_objects)
                    file.flush()
                    os.fsync(file.fileno())
                partial.replace(output)
            finally:
                partial.unlink(missing_ok=True)
    print(_sentence("backed up", counts), file=sys.stderr)


def _write(file: IO[bytes], without_objects: bool) -> dict[str, int]:  # noqa: FBT001
    from backend.cli.shared.backup_file import write_backup
    from backend.cli.shared.backup_objects import number_of_objects

    counts = write_backup(file, has_objects=not without_objects, told=show_progress)
    if without_objects and (left := number_of_objects()):
        print(f"without {left} objects: keep a backup of the bucket beside this file", file=sys.stderr)
    return counts


@contextmanager
def _explained() -> Iterator[None]:
    """Turns errors of backups and of the object store into errors of the command line."""
    from backend.cli.shared.backup_error import BackupError
    from backend.core.objects.errors import StoreError

    try:
        yield
    except BackupError as error:
        raise CliError(str(error)) from error
    except StoreError as error:
        raise CliError(
            f"{error.detail} {error.hint}",
            "To back up all but what is in the object store: --without-objects",
        ) from error


def restore(
    source: Annotated[Path, typer.Argument(help="A file that backup wrote; - reads the standard input.")],
) -> None:
    """Reads a backup into an empty server, which must not be running."""
    with stored_projects():
        from backend.cli.shared.backup_error import BackupError
        from backend.cli.shared.backup_file import read_backup

        try:
            if str(source) == "-":
                with tempfile.TemporaryFile() as file:
                    shutil.copyfileobj(sys.stdin.buffer, file)
                    counts = read_backup(file)
            else:
                with source.open("rb") as file:
                    counts = read_backup(file)
        except BackupError as error:
            raise CliError(str(error)) from error
    print(_sentence("restored", counts), file=sys.stderr)


def _sentence(done: str, counts: dict[str, int]) -> str:
    shown = (f"{counts[name]} {word}" for name, word in _SHOWN.items())
    return f"{done}: {', '.join(shown)}"


_SHOWN = {
    "accounts.user": "accounts",
    "projects.project": "projects",
    "projects.changeset": "revisions",
    "projects.blob": "files",
}
