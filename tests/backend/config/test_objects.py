"""The daily collection: of files and of recordings, where a store is set and answers."""

from __future__ import annotations

import logging
from datetime import timedelta

from django.utils import timezone

from backend.config.objects import collect_daily, collect_objects
from backend.core.objects.store import the_store


def test_objects_of_files_and_of_recordings_are_swept(db, objects):
    for key in ("blobs/a/1", "runs/b/2", "check/c/3"):
        objects.put(key)
    collect_daily()
    assert len(objects.keys()) == 3
    assert collect_objects(the_store(), now=timezone.now() + timedelta(hours=25)).swept == 2
    assert objects.keys() == {"check/c/3"}


def test_a_store_that_does_not_answer_is_logged(db, objects, settings_of, caplog):
    settings_of(**objects.settings | {"object_store": "http://127.0.0.1:9/studio"})
    with caplog.at_level(logging.WARNING):
        collect_daily()
    assert "cannot be reached" in caplog.text
    assert "Traceback" not in caplog.text
    settings_of(object_store="")
    collect_daily()
