"""Flags: the user's own marks in the recording of a run. Pure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final
from uuid import uuid4

from executor.messages import FlagSet

if TYPE_CHECKING:
    from collections.abc import Mapping

    from executor.messages import Flag

__all__ = ["MOST_FLAGS", "FlagRefused", "flag_of"]

MOST_FLAGS: Final = 200


class FlagRefused(Exception):  # noqa: N818 - an answer to a client
    """A flag is not set: a code, a sentence, and what can be done."""

    def __init__(self, code: str, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.code, self.message, self.hint = code, message, hint


def flag_of(wanted: Flag, known: Mapping[str, FlagSet], run: str, now_s: float) -> FlagSet:
    """Returns a flag as a client wants it.

    Args:
        wanted: what the client sent.
        known: the flags of the run, by id.
        run: the present run.
        now_s: the present moment in s; no flag is later.

    Raises:
        FlagRefused: the flag does not exist, has no text, is of another run, or is one too many.
    """
    if wanted.run not in ("", run):
        raise FlagRefused(
            "not_present", "Another run has begun meanwhile.", "Flags are set in the present run only."
        )
    old = known.get(wanted.id) if wanted.id else None
    if wanted.id and old is None:
        raise FlagRefused("unknown_flag", "This flag is not there any more.")
    text = wanted.text.strip()
    if old is None and not text:
        raise FlagRefused("no_text", "The flag has no text.", "Say in a few words what is to be seen here.")
    if old is None and len(known) >= MOST_FLAGS:
        hint = "Remove one that is not needed any more."
        raise FlagRefused("too_many", f"A run has at most {MOST_FLAGS} flags.", hint)
    t_s = wanted.t if wanted.t is not None else (old.t if old is not None else now_s)
    user = wanted.user if wanted.user or old is None else old.user
    return FlagSet(run, old.id if old is not None else uuid4().hex[:12], min(t_s, now_s), text, user)
