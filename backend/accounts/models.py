"""Users. On localhost there is one, without a password: whoever has the link."""

from __future__ import annotations

from django.contrib.auth.models import AbstractUser


class User(AbstractUser):
    """A person who owns projects."""
