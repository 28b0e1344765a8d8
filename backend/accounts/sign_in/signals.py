"""Receivers of signals about sign-in, sign-up and credentials.

They write the audit log and use up invitations.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from allauth.account import signals as account
from allauth.mfa import signals as mfa
from django.contrib import messages
from django.contrib.auth import get_user_model
from django.contrib.auth.signals import user_logged_in, user_logged_out
from django.db.models.signals import post_delete, post_save

from backend.accounts import invitations
from backend.accounts.audit import note
from backend.accounts.models import GroupMember
from backend.accounts.rights import lessen
from backend.accounts.texts import text

if TYPE_CHECKING:
    from backend.accounts.models import User


def on_sign_in(request: Any, user: User, **_: object) -> None:
    note("login", actor=user)


def on_sign_out(request: Any, user: User | None, **_: object) -> None:
    if user is not None:
        note("logout", actor=user)
        lessen(user_id=user.pk)


def on_user_saved(instance: User, *, created: bool, **_: object) -> None:
    """Signs out a user everywhere, after the user was deactivated or got a new password."""
    if not created:
        lessen(user_id=instance.pk)


def on_left_group(instance: GroupMember, **_: object) -> None:
    """Announces that projects shared with the group are no longer shared with the former member."""
    lessen(user_id=instance.user_id)


def on_sign_up(request: Any, user: User, **_: object) -> None:
    """Counts the invitation with which a new account was created as used."""
    note("account.create", actor=user)
    token = request.session.pop(invitations.SESSION_KEY, None)
    if isinstance(token, str):
        group = invitations.accept(token, acting_user=user, new_account=True)
        if group is not None:
            messages.success(request, text("joined", group=group.name))


def _noting(action: str) -> Any:
    def receiver(user: User, **_: object) -> None:
        note(action, actor=user)

    return receiver


def connect() -> None:
    """Connects the receivers; called when the apps are ready."""
    user_logged_in.connect(on_sign_in, dispatch_uid="bts-sign-in")
    user_logged_out.connect(on_sign_out, dispatch_uid="bts-sign-out")
    post_save.connect(on_user_saved, sender=get_user_model(), dispatch_uid="bts-user-saved")
    post_delete.connect(on_left_group, sender=GroupMember, dispatch_uid="bts-left-group")
    account.user_signed_up.connect(on_sign_up, dispatch_uid="bts-sign-up")
    for signal, action in (
        (account.password_changed, "password.change"),
        (account.password_reset, "password.reset"),
        (account.password_set, "password.set"),
        (account.email_changed, "email.change"),
        (mfa.authenticator_added, "second_factor.add"),
        (mfa.authenticator_removed, "second_factor.remove"),
    ):
        signal.connect(_noting(action), weak=False, dispatch_uid=f"bts-{action}")
