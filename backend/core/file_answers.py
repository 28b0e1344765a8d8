"""Responses whose body is a file, which is sent in parts and never held in memory as a whole."""

from __future__ import annotations

from typing import IO, TYPE_CHECKING, Any, Final
from urllib.parse import quote

from django.http import StreamingHttpResponse

if TYPE_CHECKING:
    from collections.abc import Iterator

PART: Final = 1024 * 1024


def saved_as(filename: str) -> dict[str, str]:
    """Returns the headers that make the browser save a file instead of displaying it."""
    return {
        "Content-Disposition": f"attachment; filename*=UTF-8''{quote(filename, safe='')}",
        "Content-Security-Policy": "default-src 'none'; sandbox",
    }


class FileAnswer(StreamingHttpResponse):
    """A response that sends a whole file.

    `ThreadedHandler` takes the file, sends it and closes it. Other handlers, such as the test client, read
    the response as a stream. If no handler took the file, closing the response closes it.
    """

    def __init__(self, file: IO[bytes], **options: Any) -> None:
        self._file: IO[bytes] | None = file
        size = file.seek(0, 2)
        file.seek(0)
        super().__init__(_parts(file), **options)
        self.headers["Content-Length"] = str(size)

    def take(self) -> IO[bytes]:
        """Returns the file, which the caller must close."""
        assert self._file is not None  # noqa: S101 - it is taken once
        file, self._file = self._file, None
        return file

    def close(self) -> None:
        """Closes the response, and also the file if no handler took it."""
        super().close()
        if self._file is not None:
            self._file.close()


def _parts(file: IO[bytes]) -> Iterator[bytes]:
    with file:
        while part := file.read(PART):
            yield part
