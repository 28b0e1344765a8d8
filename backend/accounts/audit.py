"""The audit log. It is empty on localhost, where there is one user."""

from __future__ import annotations

from contextvars import ContextVar
from datetime import timedelta
from typing import TYPE_CHECKING

from django.contrib.sessions.models import Session
from django.utils import timezone

from backend.accounts.models import AuditEntry
from backend.config.environment import environment

if TYPE_CHECKING:
    from datetime import datetime

    from backend.accounts.models import User

client_address: ContextVar[str | None] = ContextVar("client_address", default=None)
"""The address of the client whose request is being answered; the guard sets it."""


def note(
    action: str,
    *,
    actor: User | None,
    actor_name: str = "",
    subject: str = "",
    subject_id: object = "",
    **detail: object,
) -> None:
    """Adds an entry in the transaction of the action that it records.

    Args:
        action: `noun.verb`, such as `project.delete`.
        actor: the user who did it; None for guests and failed sign-ins, of which at most the name is stored.
        actor_name: the name that a failed sign-in gave.
        subject: the name of the changed object at that time.
        subject_id: the key of the changed object.
        detail: additional facts; nothing secret.
    """
    if not environment().is_team:
        return
    stored = actor if actor is not None and actor.pk is not None else None
    AuditEntry.objects.create(
        at=timezone.now(),
        actor=stored,
        actor_name=(stored.username if stored else actor_name)[:150],
        action=action,
        subject=subject[:200],
        subject_id=str(subject_id)[:64],
        address=client_address.get(),
        detail=detail,
    )


def forget_old(now: datetime) -> int:
    """Removes expired sign-ins and old entries; returns the number of removed entries.

    Entries are kept for `BT_STUDIO_AUDIT_DAYS`.
    """
    Session.objects.filter(expire_date__lt=now).delete()
    return AuditEntry.objects.filter(at__lt=now - timedelta(days=environment().audit_days)).delete()[0]
