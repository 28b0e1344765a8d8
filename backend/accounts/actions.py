"""Writes to users."""

from __future__ import annotations

from typing import Final

from backend.accounts.models import User

LOCAL_USER_NAME: Final = "local"


def local_user() -> User:
    """The one implicit user of a server on localhost, made when it is first asked for."""
    user = User.objects.filter(username=LOCAL_USER_NAME).first()
    if user is None:
        user, made = User.objects.get_or_create(username=LOCAL_USER_NAME)
        if made:
            user.set_unusable_password()
            user.save(update_fields=["password"])
    return user
