"""The older version that `evaluate --against` compares with: a folder, a stored revision, or one of git."""

from __future__ import annotations

import io
import re
import subprocess
import tarfile
from pathlib import Path
from typing import TYPE_CHECKING

from backend.cli.shared.errors import BAD_ARGUMENTS, CliError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from translator import Project

_STORED = re.compile(r"(.+)@(\d+)")


def open_older(newer: Project, project: str, against: str) -> Project:
    """Returns the older version, with the worlds and judges of the newer one.

    Args:
        newer: the newer version.
        project: its path or name on the command line.
        against: a folder or zip; `NAME@7`, the seventh revision of a stored project; or a revision of git of
            the folder of the project, such as HEAD~1.

    Raises:
        CliError: there is nothing of this name.
        TranslatorError: it cannot be read.
    """
    return load_in_worlds_of(newer, _files(project, against))


def open_older_alone(project: str, against: str) -> Project:
    """Returns the older version with its own worlds and judges.

    Raises:
        CliError: there is nothing of this name.
        TranslatorError: it cannot be read.
    """
    from translator import load

    return load(_files(project, against))


def load_in_worlds_of(judge: Project, files: Mapping[str, bytes]) -> Project:
    """Returns the trees and actions of some files, with the worlds and judges of another project.

    Raises:
        TranslatorError: it cannot be read.
    """
    from translator import load
    from translator.project import in_worlds_of

    return load(in_worlds_of(judge.files, files))


def _files(project: str, against: str) -> Mapping[str, bytes]:
    from backend.cli.shared import translation as cli

    if Path(against).exists():
        return cli.open_project(against).files
    if found := _STORED.fullmatch(against):
        return _stored_files(found[1], int(found[2]))
    if Path(project).is_dir():
        return _git_files(Path(project), against)
    text = f"{against}: there is no such folder; a revision of a stored project is NAME@7"
    raise CliError(text, status=BAD_ARGUMENTS)


def _stored_files(name: str, number: int) -> Mapping[str, bytes]:
    from backend.cli.shared.stored import find_project, stored_projects

    with stored_projects():
        from backend.projects.storage.queries import files_at

        return {path: file.data for path, file in files_at(find_project(name), number).items()}


def _git_files(folder: Path, revision: str) -> dict[str, bytes]:
    """Returns the files of a folder as they were in a revision of git."""
    from translator.archive import safe_path
    from translator.limits import FILES_PER_PROJECT, PROJECT_BYTES

    if revision.startswith("-"):
        raise CliError(f"{revision}: this is no revision", status=BAD_ARGUMENTS)
    try:
        done = subprocess.run(
            ["git", "-C", str(folder), "archive", "--format=tar", revision, "."],
            capture_output=True,
            check=False,
        )
    except FileNotFoundError:
        raise CliError("git is not installed", status=BAD_ARGUMENTS) from None
    if done.returncode != 0:
        why = done.stderr.decode("utf-8", "replace").strip().splitlines()
        text = f"{folder}:1:1: it has no revision {revision!r} in git: {why[0] if why else 'git failed'}"
        raise CliError(text, status=BAD_ARGUMENTS)
    files: dict[str, bytes] = {}
    left = PROJECT_BYTES
    with tarfile.open(fileobj=io.BytesIO(done.stdout)) as archive:
        for entry in archive:
            name = safe_path(entry.name) if entry.isfile() else None
            held = archive.extractfile(entry) if name is not None else None
            if name is None or held is None:
                continue
            left -= entry.size
            if left < 0 or len(files) >= FILES_PER_PROJECT:
                raise CliError(
                    f"{folder}:1:1: revision {revision!r} is larger than a project", status=BAD_ARGUMENTS
                )
            files[name] = held.read()
    return files
