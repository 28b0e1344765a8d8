"""Tells whoever has a project open that it has a new revision; what changed is fetched, not sent.

A notice is small and may be lost (a full channel drops it): the number in the next one says the same.
"""

from __future__ import annotations

from contextlib import asynccontextmanager
from typing import TYPE_CHECKING, Any, Final

from channels.layers import get_channel_layer
from django.db import transaction
from django.db.models.signals import post_save

from backend.config.telling import tell
from backend.projects.models import ChangeSet

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Awaitable, Callable
    from uuid import UUID

KIND: Final = "revision"


def watch_revisions() -> None:
    """From now on each change set is announced when it is committed."""
    post_save.connect(_announce_later, sender=ChangeSet, dispatch_uid="announce_revision")


def _announce_later(sender: object, *, instance: ChangeSet, created: bool, **_: object) -> None:
    if not created:
        return
    notice = {
        "type": KIND,
        "revision": instance.number,
        "author": instance.author.username if instance.author else "",
        "message": instance.message,
    }
    group = group_of(instance.project_id)
    # Robust: a lost notice must not make a save that is stored look as if it had failed.
    transaction.on_commit(lambda: tell(group, notice), robust=True)


def group_of(project_id: UUID) -> str:
    """The channel layer's group of those who have the project open."""
    return f"project.{project_id}"


@asynccontextmanager
async def notices_of(project_id: UUID) -> AsyncIterator[Callable[[], Awaitable[dict[str, Any]]]]:
    """Gives a function that waits for the next notice."""
    layer = get_channel_layer()
    channel = await layer.new_channel()
    await layer.group_add(group_of(project_id), channel)
    try:
        yield lambda: layer.receive(channel)
    finally:
        await layer.group_discard(group_of(project_id), channel)
