"""Answers that lie in a file, and are sent from there part by part: never all of them in memory."""

from __future__ import annotations

from typing import IO, TYPE_CHECKING, Any, Final

from django.http import StreamingHttpResponse

if TYPE_CHECKING:
    from collections.abc import Iterator

PART: Final = 1024 * 1024


class FileAnswer(StreamingHttpResponse):
    """A file from its beginning to its end.

    The handler takes the file, sends it and closes it; handlers that know nothing of it read the response as
    a stream. A response that is closed before that closes its file.
    """

    def __init__(self, file: IO[bytes], **options: Any) -> None:
        self._file: IO[bytes] | None = file
        size = file.seek(0, 2)
        file.seek(0)
        super().__init__(_parts(file), **options)
        self.headers["Content-Length"] = str(size)

    def take(self) -> IO[bytes]:
        """The file, which is now the caller's to close."""
        assert self._file is not None  # noqa: S101 - it is taken once
        file, self._file = self._file, None
        return file

    def close(self) -> None:
        """Ends the response, and the file if nobody took it."""
        super().close()
        if self._file is not None:
            self._file.close()


def _parts(file: IO[bytes]) -> Iterator[bytes]:
    with file:
        while part := file.read(PART):
            yield part
