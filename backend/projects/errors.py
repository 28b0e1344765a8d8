"""Errors of projects; the tree of exceptions starts at `backend.core.problems.StudioError`."""

from __future__ import annotations

from backend.core.problems import StudioError


class RevisionConflictError(StudioError):
    """Another user changed a file since the revision on which the write is based."""

    status = 409
    code = "revision_conflict"
    title = "Someone else changed this file"


class NameTakenError(StudioError):
    """The user has another project with this name."""

    status = 409
    code = "name_taken"
    title = "The name is taken"


class QuotaExceededError(StudioError):
    """The write would exceed the quota."""

    status = 413
    code = "quota_exceeded"
    title = "Too large"


class PreconditionFailedError(StudioError):
    """`If-Match` names a revision that is no longer the newest."""

    status = 412
    code = "precondition_failed"
    title = "The project has changed"


class CheckFailedError(StudioError):
    """The project has errors that prevent it from running; they are in `diagnostics`."""

    status = 422
    code = "check_failed"
    title = "The project has errors"


class ArchiveError(StudioError):
    """An imported file is not an archive that can be read."""

    status = 422
    code = "bad_archive"
    title = "The archive cannot be imported"


class IdempotencyError(StudioError):
    """One idempotency key was used for two different requests."""

    status = 422
    code = "idempotency_key_reused"
    title = "The idempotency key was used for another request"


def matches(if_match: str, etag: str, sentence: str, revision: int | None = None) -> None:
    """Raises PreconditionFailedError with this sentence if the `If-Match` header names another ETag."""
    if not if_match or if_match.strip() == "*":
        return
    if etag not in {tag.strip().removeprefix("W/") for tag in if_match.split(",")}:
        raise PreconditionFailedError(sentence, hint="Load it again.", revision=revision)
