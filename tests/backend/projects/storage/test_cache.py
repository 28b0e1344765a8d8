"""Contents and lists in the cache: they are correct, and their number is limited."""

from __future__ import annotations

import pytest
from cachetools import LRUCache

from backend.projects.models import Blob, Project
from backend.projects.storage import cache
from backend.projects.storage.changes import Content


@pytest.fixture
def fresh(monkeypatch):
    """Empty caches of a size that a test chooses."""

    def make(*, room=cache.ROOM, files=cache.FILES):
        monkeypatch.setattr(cache, "kept_contents", LRUCache(room, getsizeof=len))
        monkeypatch.setattr(cache, "kept_lists", LRUCache(files, getsizeof=cache.kept_lists.getsizeof))

    make()
    return make


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


def test_what_was_not_used_for_longest_goes_first(fresh, db):
    fresh(room=20)
    for name in "abc":
        cache.put(name, name.encode() * 8)
        cache.contents(["a"])
    assert cache.contents("abc") == {"a": b"a" * 8, "c": b"c" * 8}


def test_a_large_content_is_fetched_each_time(fresh, db, monkeypatch):
    monkeypatch.setattr(cache, "LARGEST", 3)
    cache.put("a", b"1234")
    cache.put("b", b"123")
    assert cache.contents("ab") == {"b": b"123"}


def test_not_more_files_are_kept_than_there_is_room_for(fresh):
    fresh(files=5)
    projects = [Project(revision=1) for _ in range(3)]
    for project in projects:
        cache.put_files(project, dict.fromkeys("ab"))
    assert [cache.files(project) is not None for project in projects] == [False, True, True]
    cache.put_files(projects[2], dict.fromkeys("abc"))
    assert [cache.files(project) is not None for project in projects] == [False, True, True]


def test_more_files_than_there_is_room_for_are_not_kept(fresh, monkeypatch):
    monkeypatch.setattr(cache, "FILES", 2)
    project = Project(revision=1)
    cache.put_files(project, dict.fromkeys("abc"))
    assert cache.files(project) is None
