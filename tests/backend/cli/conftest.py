"""Fixtures of a server with accounts."""

from __future__ import annotations

from tests.backend.accounts.conftest import person, stranger, team

__all__ = ["person", "stranger", "team"]
