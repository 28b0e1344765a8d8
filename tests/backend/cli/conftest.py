"""Fixtures of a server with accounts, and a stored place for the verbs of projects."""

from __future__ import annotations

import pytest

from backend.config import server
from tests.backend.accounts.conftest import person, stranger, team

__all__ = ["person", "stored_place", "stranger", "team"]


@pytest.fixture
def stored_place(db, monkeypatch, settings_of, tmp_path):
    """Django is set up already in the tests, and the database is that of the tests."""
    settings_of(data_dir=tmp_path)
    monkeypatch.setattr(server, "migrate", lambda: None)
    return tmp_path
