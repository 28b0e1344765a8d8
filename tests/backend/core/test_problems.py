"""Errors as problem documents."""

from __future__ import annotations

import errno
import os

import pytest
from django.db import connection

from backend.core.problems import MEDIA_TYPE, NotFoundError, StudioError
from backend.core.rest.openapi import ProblemSerializer
from backend.core.scratch import Scratch


def test_an_error_has_a_code_a_sentence_and_what_to_do(api):
    document = api.get("projects/3f2504e0-4f89-41d3-9a0c-000000000001", expect=404)
    assert api.response.headers["Content-Type"].startswith(MEDIA_TYPE)
    assert document["code"] == NotFoundError.code
    assert set(document) >= {name for name, field in ProblemSerializer().fields.items() if field.required}


def test_every_error_has_a_status_and_a_code_of_its_own() -> None:
    found, waiting = [], [StudioError]
    while waiting:
        error = waiting.pop()
        waiting += error.__subclasses__()
        found.append(error)
    assert all(400 <= error.status < 600 and error.title and error.code for error in found)


@pytest.mark.django_db(transaction=True)
def test_a_database_that_is_read_only_is_no_fault_of_the_program(api):
    one = api.post("projects", {"name": "One"}, expect=201)["id"]
    with connection.cursor() as cursor:
        is_sqlite = connection.vendor == "sqlite"
        on, off = ("PRAGMA query_only = 1", "PRAGMA query_only = 0")
        if not is_sqlite:
            on, off = (f"SET default_transaction_read_only = {value}" for value in ("on", "off"))
        cursor.execute(on)
        try:
            found = api.post("projects", {"name": "Two"}, expect=507)
            assert api.get(f"projects/{one}")["name"] == "One"
        finally:
            cursor.execute(off)
    assert found["code"] == "read_only"
    assert "fault of BT Studio" not in found["detail"]


@pytest.mark.parametrize(
    ("number", "code"),
    [
        (errno.EROFS, "read_only"),
        (errno.EACCES, "read_only"),
        (errno.ENOSPC, "disk_full"),
        (errno.EDQUOT, "disk_full"),
    ],
)
def test_a_data_folder_that_cannot_be_written_is_no_fault_of_the_program(
    api, project, monkeypatch, number, code
):
    def refused(*_, **__):
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(Scratch, "file", refused)
    assert api.get(f"projects/{project['id']}/export", expect=507)["code"] == code
