"""The database between two tests that commit."""

from __future__ import annotations

import pytest
from django.contrib.contenttypes.models import ContentType
from django.test import testcases

from backend.accounts.models import User
from tests.backend import emptied

pytestmark = pytest.mark.django_db(transaction=True)


def flush() -> None:
    """Does the same as Django after a test that commits."""
    testcases.call_command("flush", verbosity=0, interactive=False)  # type: ignore[attr-defined]


def test_rows_of_a_test_are_removed_and_those_of_migrations_stay() -> None:
    kept = emptied.rows()
    assert kept == emptied.kept_rows()
    assert kept["django_content_type"] == ContentType.objects.count()
    User.objects.create(username="ada")
    assert emptied.rows() != kept
    flush()
    assert emptied.rows() == kept


def test_rows_of_migrations_that_a_test_removes_are_made_again() -> None:
    kept = emptied.rows()
    ContentType.objects.first().delete()
    assert not emptied.empty()
    flush()
    assert emptied.rows() == kept
