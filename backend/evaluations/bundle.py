"""The files that an executor gets for an evaluation."""

from __future__ import annotations

import base64
import json
from typing import IO, TYPE_CHECKING, Any, Final

from backend.core.scratch import scratch
from backend.projects.documents.export import write_zip
from backend.projects.errors import QuotaExceededError
from backend.projects.storage.queries import listed_at
from translator.project import in_worlds_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from backend.evaluations.models import Evaluation

MOST_PACKED: Final = 95 << 20
"""Bytes of an archive; as base64, with the rest of its command, an executor takes no more (128 MB)."""
PART: Final = 3 * 256 * 1024
"""Bytes that are sent as base64 at once; a multiple of three."""


def archive_of(found: Evaluation, revision: int) -> IO[bytes]:
    """Returns the project as it was at a revision, as a zip in a temporary file.

    Its contents are fetched part by part, so that it is never completely in memory.

    Raises:
        NoRoomError: too many large files are there already.
        QuotaExceededError: it is larger than an executor takes.
    """
    files = listed_at(found.project, revision)
    if revision != found.revision:
        files = in_worlds_of(listed_at(found.project, found.revision), files)
    archive = scratch().file(expected=sum(file.size for file in files.values()))
    try:
        write_zip(files.items(), archive)
        if (size := archive.tell()) > MOST_PACKED:
            raise QuotaExceededError(
                f"The project takes {size >> 20} MB as a zip, and a session takes {MOST_PACKED >> 20} MB."
            )
    except BaseException:
        archive.close()
        raise
    return archive


def message_with(archive: IO[bytes], message: dict[str, Any]) -> Iterator[str]:
    """Yields the parts of a command with its archive, as JSON."""
    text = json.dumps(message | {"data": {**message["data"], "app_zip_base64": ""}})
    begin, end = text[: -len('"}}')], text[-len('"}}') :]
    yield begin
    archive.seek(0)
    while part := archive.read(PART):
        yield base64.b64encode(part).decode()
    yield end
