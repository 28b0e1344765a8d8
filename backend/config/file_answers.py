"""Answers that lie in a file, and are sent from there part by part: never all of them in memory."""

from __future__ import annotations

from typing import IO, TYPE_CHECKING, Any, Final

from django.http import StreamingHttpResponse

if TYPE_CHECKING:
    from collections.abc import Iterator

PART: Final = 1024 * 1024


class FileAnswer(StreamingHttpResponse):
    """A file from its beginning to its end.

    The handler sends `file` and closes it; handlers that know nothing of it read the response as a stream,
    at whose end the file is closed, too.
    """

    def __init__(self, file: IO[bytes], **options: Any) -> None:
        self.file = file
        size = file.seek(0, 2)
        file.seek(0)
        super().__init__(_Parts(file), **options)
        self.headers["Content-Length"] = str(size)


class _Parts:
    """The parts of a file; it has no `close`, which the end of the response would call."""

    def __init__(self, file: IO[bytes]) -> None:
        self._file = file

    def __iter__(self) -> Iterator[bytes]:
        with self._file:
            while part := self._file.read(PART):
                yield part
