"""Links that set a new password, without e-mail."""

from __future__ import annotations

from typing import TYPE_CHECKING

from allauth.account.forms import default_token_generator
from allauth.account.utils import user_pk_to_url_str

from backend.config.environment import environment

if TYPE_CHECKING:
    from backend.accounts.models import User


def link(user: User) -> str:
    """Returns a link that works once, for `PASSWORD_RESET_TIMEOUT` (three days)."""
    key = default_token_generator.make_token(user)
    return f"{environment().public_url}/accounts/password/reset/key/{user_pk_to_url_str(user)}-{key}/"
