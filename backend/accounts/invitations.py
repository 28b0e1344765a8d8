"""Invitations: links with which people create an account and join a group."""

from __future__ import annotations

from datetime import timedelta
from typing import TYPE_CHECKING, Final

from django.db import transaction
from django.db.models import F
from django.utils import timezone

from backend.accounts import links
from backend.accounts.audit import note
from backend.accounts.models import Group, GroupMember, Invitation
from backend.accounts.permissions import TeacherRequiredError
from backend.core.problems import NotFoundError

if TYPE_CHECKING:
    from uuid import UUID

    from django.http import HttpRequest

    from backend.accounts.models import User

SESSION_KEY: Final = "invitation"


def may_invite(user: User) -> bool:
    """Returns whether the user may invite people: teachers and administrators may."""
    return user.is_teacher or user.is_superuser


@transaction.atomic
def invite(*, acting_user: User, group: Group | None, days: int, max_uses: int) -> Invitation:
    """Makes a link that `max_uses` people can use for `days` days.

    Raises:
        TeacherRequiredError: the user may not invite people.
    """
    if not may_invite(acting_user):
        raise TeacherRequiredError("Invitations are for teachers and administrators.")
    now = timezone.now()
    made = Invitation.objects.create(
        created_by=acting_user,
        group=group,
        created_at=now,
        expires_at=now + timedelta(days=days),
        max_uses=max_uses,
    )
    subject = group.name if group else ""
    note("invitation.create", actor=acting_user, subject=subject, subject_id=made.id, max_uses=max_uses)
    return made


@transaction.atomic
def revoke(invitation_id: UUID, *, acting_user: User) -> None:
    """Revokes an invitation. Accounts that were made with it stay.

    Raises:
        NotFoundError: the user has not made such an invitation.
    """
    rows = Invitation.objects.select_for_update().filter(id=invitation_id, revoked_at=None)
    if not acting_user.is_superuser:
        rows = rows.filter(created_by=acting_user)
    found = rows.first()
    if found is None:
        raise NotFoundError("There is no such invitation.")
    found.revoked_at = timezone.now()
    found.save(update_fields=["revoked_at"])
    note("invitation.revoke", actor=acting_user, subject_id=found.id)


def usable(identity: UUID | None) -> Invitation | None:
    """Returns an invitation if it can be used, otherwise None.

    It must not be expired, used up or revoked, and its author must be active.
    """
    if identity is None:
        return None
    return (
        Invitation.objects.select_related("group", "created_by")
        .filter(
            id=identity,
            revoked_at=None,
            expires_at__gt=timezone.now(),
            uses__lt=F("max_uses"),
            created_by__is_active=True,
        )
        .first()
    )


def of_token(token: str) -> Invitation | None:
    """Returns the invitation that the token of a link names, if it is valid; otherwise None."""
    return usable(links.identity_of("join", token))


def of_browser(request: HttpRequest) -> Invitation | None:
    """Returns the invitation that this browser opened last, if it is valid; otherwise None."""
    token = request.session.get(SESSION_KEY)
    return of_token(token) if isinstance(token, str) else None


@transaction.atomic
def accept(token: str, *, acting_user: User, new_account: bool) -> Group | None:
    """Counts the invitation as used and adds the user to its group; returns the group.

    If the user already is a member of the group, the invitation is not counted as used. Returns None for an
    invitation without a group.
    """
    identity = links.identity_of("join", token)
    if identity is None:
        return None
    if Invitation.objects.select_for_update().filter(id=identity).first() is None:
        return None
    found = usable(identity)
    if found is None:
        return None
    joined = False
    if found.group is not None and found.group.owner_id != acting_user.pk:
        _, joined = GroupMember.objects.get_or_create(
            group=found.group, user=acting_user, defaults={"joined_at": timezone.now()}
        )
    if joined or new_account:
        Invitation.objects.filter(id=found.id).update(uses=F("uses") + 1)
        subject = found.group.name if found.group else ""
        note("invitation.accept", actor=acting_user, subject=subject, subject_id=found.id)
    return found.group
