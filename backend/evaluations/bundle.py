"""The files that an executor gets for an evaluation."""

from __future__ import annotations

import base64
import io
import zipfile
from typing import TYPE_CHECKING, Final

from backend.projects.storage.queries import files_at

if TYPE_CHECKING:
    from collections.abc import Mapping

    from backend.evaluations.models import Evaluation

OF_THE_WORLD: Final = ("evaluations/", "universes/", "robots/", "assets/")
"""Folders that an older revision takes from the evaluated one, so that both run in the same worlds."""


def archive_of(found: Evaluation, revision: int) -> str:
    """Returns the project as it was at a revision, as a zip in base64."""
    files = {path: file.data for path, file in files_at(found.project, revision).items()}
    if revision != found.revision:
        newer = {path: file.data for path, file in files_at(found.project, found.revision).items()}
        files = in_the_worlds_of(newer, files)
    return zipped(files)


def in_the_worlds_of(newer: Mapping[str, bytes], older: Mapping[str, bytes]) -> dict[str, bytes]:
    """Returns the older files, with the evaluations, universes, robots and assets of the newer ones."""
    kept = {path: data for path, data in older.items() if not path.startswith(OF_THE_WORLD)}
    return kept | {path: data for path, data in newer.items() if path.startswith(OF_THE_WORLD)}


def zipped(files: Mapping[str, bytes]) -> str:
    """Returns files as a zip in base64."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for path, data in sorted(files.items()):
            archive.writestr(path, data)
    return base64.b64encode(out.getvalue()).decode()
