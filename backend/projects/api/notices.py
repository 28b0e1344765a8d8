"""Notifies all pages that have a project open of a new revision. Pages fetch the changes; they are not sent.

A notice is small and may be lost (a full channel drops it); the next notice has a higher number.
"""

from __future__ import annotations

from contextlib import asynccontextmanager
from typing import TYPE_CHECKING, Any, Final

from django.db import transaction

from backend.core.notify import following, tell
from backend.projects.signals import revision_made

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Awaitable, Callable
    from uuid import UUID

    from backend.projects.models import ChangeSet

KIND: Final = "revision"


def watch_revisions() -> None:
    """Connects the notices to the signal of a committed change set."""
    revision_made.connect(_announce_later, dispatch_uid="announce_revision")


def _announce_later(sender: object, *, change: ChangeSet, **_: object) -> None:
    notice = {
        "type": KIND,
        "revision": change.number,
        "author": change.author.username if change.author else "",
        "message": change.message,
    }
    group = group_of(change.project_id)
    # With `robust`, a lost notice does not make a stored save look as if it had failed.
    transaction.on_commit(lambda: tell(group, notice), robust=True)


def group_of(project_id: UUID) -> str:
    """Returns the channel layer's group of all pages that have the project open."""
    return f"project.{project_id}"


@asynccontextmanager
async def notices_of(project_id: UUID) -> AsyncIterator[Callable[[], Awaitable[dict[str, Any]]]]:
    """Yields a function that waits for the next notice about a project.

    Raises:
        NoNoticesError: Redis does not answer.
    """
    async with following(group_of(project_id)) as next_notice:
        yield next_notice
