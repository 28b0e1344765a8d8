"""Instances of models from rows of SQL."""

from __future__ import annotations

from django.db import connection

from backend.accounts.models import User
from backend.core.instances import columns, instance


def test_a_row_is_the_instance_that_the_models_own_query_gives(user):
    with connection.cursor() as cursor:
        query = f"SELECT {columns(User)}, 5 FROM {User._meta.db_table} WHERE id = %s"  # noqa: S608 - our own names
        cursor.execute(query, [user.pk])
        row = cursor.fetchone()
    found = instance(User, row)
    expected = User.objects.get(pk=user.pk)
    for field in User._meta.concrete_fields:
        assert getattr(found, field.attname) == getattr(expected, field.attname)
    assert row[-1] == 5
