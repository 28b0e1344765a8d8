"""Pulls a recording from the manager of a session, part by part. What comes is not trusted, but counted."""

from __future__ import annotations

import contextlib
import http.client
import re
import time
from typing import IO, TYPE_CHECKING, Final

from backend.runs.errors import NoAnswerError, NotRecordedError, RunQuotaError
from backend.sessions.manager.address import http_connection

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["DEADLINE_S", "LAST", "pull"]

LAST: Final = "last"
ANSWER_S: Final = 130.0  # the manager joins the segments for at most two minutes
DEADLINE_S: Final = 300.0
MOST_TRIES: Final = 3
CHUNK_BYTES: Final = 1 << 20
MOST_PART_BYTES: Final = 16 << 20
_RANGE: Final = re.compile(r"bytes (\d{1,15})-(\d{1,15})/(\d{1,15})")
_AGAIN: Final = "Try again; the run stays recorded while the session lives."


class _ChangedError(Exception):
    """Another client made the manager join the recording again, so that it has become longer."""


def pull(  # noqa: PLR0913, PLR0917 - where from, what, where to, and how much
    address: str, token: str, recorded_as: str, out: IO[bytes], most: int, deadline_s: float = DEADLINE_S
) -> int:
    """Writes a recording to a file; returns its size in bytes.

    Args:
        address: the manager's address (`backend.sessions.manager.address`).
        token: the manager's token.
        recorded_as: the name that the session gave the run, or `LAST` for the last one.
        out: the file.
        most: the largest size in bytes.
        deadline_s: how long it may take, in s.

    Raises:
        NotRecordedError: there is no such run.
        RunQuotaError: it is larger than `most`.
        NoAnswerError: the manager does not answer, or its answer is not a recording.
    """
    end_s = time.monotonic() + deadline_s
    try:
        for _ in range(MOST_TRIES):
            out.seek(0)
            out.truncate()
            with contextlib.suppress(_ChangedError):
                return _pull(address, token, recorded_as, out, most, end_s)
    except (OSError, http.client.HTTPException) as error:
        raise NoAnswerError("The session did not give the recording.", hint=_AGAIN) from error
    raise NoAnswerError("The recording changed each time that it was read.", hint=_AGAIN)


def _pull(  # noqa: PLR0913, PLR0917 - as `pull`, and the deadline
    address: str, token: str, recorded_as: str, out: IO[bytes], most: int, end_s: float
) -> int:
    size, total, tag = 0, 1, None
    while size < total:
        left_s = end_s - time.monotonic()
        if left_s <= 0:
            raise NoAnswerError("The session took too long to give the recording.", hint=_AGAIN)
        connection = http_connection(address, min(ANSWER_S, left_s))
        try:
            headers = {"Authorization": f"Bearer {token}", "Range": f"bytes={size}-"}
            connection.request("GET", f"/recordings/{recorded_as}/0", headers=headers)
            with connection.getresponse() as answer:  # an answer that is not read to its end holds the socket
                length, total = _described(answer, size, recorded_as)
                if total > most:
                    raise RunQuotaError(
                        f"The run has {total:,} bytes, and you have room for {max(0, most):,}.",
                        hint="Delete runs that you no longer need.",
                    )
                if tag not in (None, answer.headers.get("ETag")):
                    raise _ChangedError
                tag = answer.headers.get("ETag")
                for chunk in _chunks(answer, length):
                    out.write(chunk)
            size += length
        finally:
            connection.close()
    return size


def _described(answer: http.client.HTTPResponse, at: int, recorded_as: str) -> tuple[int, int]:
    """Returns the length of a part, and the size of the whole recording."""
    if answer.status == http.client.NOT_FOUND:
        raise NotRecordedError(
            f"The session has no recording of the run {recorded_as}.", hint="Press Run, then keep the run."
        )
    named = _RANGE.fullmatch(answer.headers.get("Content-Range", ""))
    if answer.status != http.client.PARTIAL_CONTENT or named is None:
        raise NoAnswerError("The session could not put the recording together.", hint=_AGAIN)
    begin, last, total = (int(text) for text in named.groups())
    if begin != at or not at <= last < total or last - begin >= MOST_PART_BYTES:
        raise NoAnswerError("The session gave another part than was asked for.", hint=_AGAIN)
    return last - begin + 1, total


def _chunks(answer: http.client.HTTPResponse, length: int) -> Iterator[bytes]:
    left = length
    while left:
        chunk = answer.read(min(CHUNK_BYTES, left))
        if not chunk:
            raise NoAnswerError("The recording ended too early.", hint=_AGAIN)
        left -= len(chunk)
        yield chunk
