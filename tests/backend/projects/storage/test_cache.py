"""Contents that are kept in memory: the right ones, and not too many."""

from __future__ import annotations

import pytest

from backend.projects.models import Blob
from backend.projects.storage import cache
from backend.projects.storage.changes import Content


@pytest.fixture
def fresh(monkeypatch):
    found = cache._Kept()
    monkeypatch.setattr(cache, "_kept", found)
    return found


def stored(text):
    content = Content.of(text.encode())
    Blob.objects.create(sha256=content.sha256, size=content.size, data=content.data)
    return content


def test_what_is_missing_is_fetched_at_once_and_only_once(fresh, db, django_assert_num_queries):
    one, two = stored("one"), stored("two")
    wanted = {one.sha256: one.data, two.sha256: two.data}
    with django_assert_num_queries(1):
        assert cache.contents(wanted) == wanted
    with django_assert_num_queries(0):
        assert cache.contents(wanted) == wanted


def test_a_content_that_nobody_stored_is_left_out(fresh, db):
    assert cache.contents(["0" * 64]) == {}


def test_what_was_not_used_for_longest_goes_first(fresh, monkeypatch):
    monkeypatch.setattr(cache, "ROOM", 20)
    for name in "abc":
        fresh.put(name, name.encode() * 8)
        fresh.get(["a"])
    assert fresh.get("abc") == {"a": b"a" * 8, "c": b"c" * 8}


def test_a_large_content_is_fetched_each_time(fresh, monkeypatch):
    monkeypatch.setattr(cache, "LARGEST", 3)
    fresh.put("a", b"1234")
    fresh.put("b", b"123")
    assert fresh.get("ab") == {"b": b"123"}
