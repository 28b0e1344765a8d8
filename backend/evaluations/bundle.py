"""The files that an executor gets for an evaluation."""

from __future__ import annotations

import base64
import io
import zipfile
from typing import TYPE_CHECKING

from backend.projects.storage.queries import files_at
from translator.project import in_worlds_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from backend.evaluations.models import Evaluation


def archive_of(found: Evaluation, revision: int) -> str:
    """Returns the project as it was at a revision, as a zip in base64."""
    files = {path: file.data for path, file in files_at(found.project, revision).items()}
    if revision != found.revision:
        newer = {path: file.data for path, file in files_at(found.project, found.revision).items()}
        files = in_worlds_of(newer, files)
    return zipped(files)


def zipped(files: Mapping[str, bytes]) -> str:
    """Returns files as a zip in base64."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for path, data in sorted(files.items()):
            archive.writestr(path, data)
    return base64.b64encode(out.getvalue()).decode()
