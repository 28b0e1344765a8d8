"""Writes to users."""

from __future__ import annotations

from typing import Final

from django.contrib.auth.password_validation import validate_password
from django.core.exceptions import ValidationError
from django.core.validators import validate_email
from django.db import transaction
from django.db.models import Q

from backend.accounts.audit import note
from backend.accounts.models import User
from backend.accounts.signals_out import account_leaves
from backend.core.problems import InvalidInputError, StudioError

LOCAL_USER_NAME: Final = "local"


class AccountTakenError(StudioError):
    """Another account has the name or the address."""

    status = 409
    code = "account_taken"
    title = "The account exists"


class LastAdministratorError(StudioError):
    """The change would leave the server without an administrator."""

    status = 409
    code = "last_administrator"
    title = "The last administrator stays"


def local_user() -> User:
    """Returns the only user of a server on localhost; creates the user at the first call."""
    user = User.objects.filter(username=LOCAL_USER_NAME).first()
    if user is None:
        user, made = User.objects.get_or_create(username=LOCAL_USER_NAME)
        if made:
            user.set_unusable_password()
            user.save(update_fields=["password"])
    return user


def user_named(name: str) -> User | None:
    """Returns the account with this name or e-mail address, active or not; None if there is none."""
    return User.objects.filter(Q(username=name) | Q(email__iexact=name or "-")).first()


def an_administrator() -> User | None:
    """Returns an active administrator, preferably one with a password; None if there is none."""
    found = list(User.objects.filter(is_superuser=True, is_active=True).order_by("pk"))
    return next((user for user in found if user.has_usable_password()), next(iter(found), None))


@transaction.atomic
def create_account(
    name: str, *, email: str, password: str, is_admin: bool = False, is_teacher: bool = False
) -> User:
    """Makes an account for another person; the address counts as verified.

    Raises:
        InvalidInputError: the name, the address or the password is invalid.
        AccountTakenError: another account has the name or the address.
    """
    from allauth.account.models import EmailAddress  # noqa: PLC0415 - models must be loaded

    user = User(username=name, email=email, is_teacher=is_teacher)
    user.is_staff = user.is_superuser = is_admin
    try:
        User.username_validator(name)
        if email:
            validate_email(email)
        if password:
            validate_password(password, user)
    except ValidationError as error:
        raise InvalidInputError(" ".join(error.messages)) from error
    if name == LOCAL_USER_NAME or user_named(name) or (email and user_named(email)):
        raise AccountTakenError(f"The name “{name}” or the address is taken.", hint="Choose another one.")
    user.set_password(password or None)
    user.save()
    if email:
        EmailAddress.objects.create(user=user, email=email, verified=True, primary=True)
    note("account.create", actor=user, by="command line")
    return user


@transaction.atomic
def delete_account(user: User) -> None:
    """Removes a user with everything that they own.

    Their revisions of other users' projects stay, without a name.

    Raises:
        LastAdministratorError: the user is the last administrator.
    """
    others = User.objects.select_for_update().filter(is_superuser=True, is_active=True).exclude(pk=user.pk)
    if user.is_superuser and not others.exists():
        raise LastAdministratorError(
            "You are the only administrator of this server.", hint="Make someone else administrator first."
        )
    account_leaves.send(User, user=user)
    note("account.delete", actor=None, actor_name=user.username, subject=user.username)
    user.delete()
