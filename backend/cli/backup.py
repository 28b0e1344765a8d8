"""`bt-studio backup` and `bt-studio restore`: copy all data of a server to and from one file."""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from pathlib import Path  # noqa: TC003 - read at run time
from typing import Annotated

import typer

from backend.cli.shared.errors import CliError
from backend.cli.shared.stored import stored_projects


def backup(
    output: Annotated[Path, typer.Argument(help="The zip to write; - writes to the standard output.")],
) -> None:
    """Writes all accounts, projects and revisions to one file; the server may keep running."""
    with stored_projects():
        from backend.cli.shared.backup_file import write_backup

        if str(output) == "-":
            counts = write_backup(sys.stdout.buffer)
        else:
            partial = output.with_name(output.name + ".partial")
            descriptor = os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
            try:
                with os.fdopen(descriptor, "wb") as file:
                    counts = write_backup(file)
                    file.flush()
                    os.fsync(file.fileno())
                partial.replace(output)
            finally:
                partial.unlink(missing_ok=True)
    print(_sentence("backed up", counts), file=sys.stderr)


def restore(
    source: Annotated[Path, typer.Argument(help="A file that backup wrote; - reads the standard input.")],
) -> None:
    """Reads a backup into an empty server, which must not be running."""
    with stored_projects():
        from backend.cli.shared.backup_file import BackupError, read_backup

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
