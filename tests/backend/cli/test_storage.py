"""`bt-studio admin storage`."""

from __future__ import annotations

import base64
import random
import re

import pytest

from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
from backend.cli.storage import check, collect, migrate, undo
from backend.core.objects.store import the_store
from backend.projects.models import Blob

LARGE = random.Random(9).randbytes((1 << 20) + 1)  # noqa: S311


@pytest.fixture
def place(stored_place, api, project, objects, settings_of):
    """A server with a large file in its database, and a bucket."""
    settings_of(object_store="")
    file = {"path": "a.bin", "base_revision": 0, "content_base64": base64.b64encode(LARGE).decode()}
    api.save(project["id"], file)
    settings_of(**objects.settings)
    return objects


def said(capsys, command):
    command()
    return capsys.readouterr().out


def test_a_bucket_is_filled_checked_and_emptied(place, capsys, settings_of):
    assert "1 in the database that `migrate` would move" in said(capsys, check)
    out = said(capsys, migrate)
    assert f"files: 1 ({len(LARGE):,} bytes) moved to the bucket “studio” at http" in out
    assert "recordings: 0 (0 bytes)" in out
    assert f"files: 1 in the bucket ({len(LARGE):,} bytes), 0 in the database" in said(capsys, check)
    assert said(capsys, collect) == "0 files marked, 0 deleted; 0 objects without a row.\n"
    assert "files: 0 (0 bytes)" in said(capsys, migrate)
    with pytest.raises(CliError, match="BT_STUDIO_OBJECT_STORE_WRITES=false") as refused:
        undo()
    assert refused.value.status == BAD_ARGUMENTS
    settings_of(**place.settings, object_store_writes="false")
    with pytest.raises(CliError, match="set it to true"):
        migrate()
    assert "files: 1" in said(capsys, undo)
    assert place.keys() == set()
    assert not Blob.objects.filter(data=None).exists()


def test_missing_objects_are_named(place, capsys):
    migrate()
    (key,) = place.keys()
    the_store().delete([key])
    with pytest.raises(CliError, match=re.escape(key)):
        check()
    place.put(key)
    with pytest.raises(CliError, match="1 objects are missing or of another size"):
        check()


def test_an_interrupted_move_says_that_it_continues(place, capsys, monkeypatch):
    put = the_store().put

    def broken(key, *content):
        if key.startswith("blobs/"):
            raise KeyboardInterrupt
        put(key, *content)

    monkeypatch.setattr(the_store(), "put", broken)
    with pytest.raises(KeyboardInterrupt):
        migrate()
    assert "files: 0 of 1 were moved; the same command continues." in capsys.readouterr().err


def test_what_is_wrong_is_one_sentence(place, settings_of):
    for command in (check, migrate, collect):
        settings_of(object_store="")
        with pytest.raises(CliError, match="No object store is set"):
            command()
        for address, says in (
            (f"{place.origin}/nothing", "no such bucket"),
            ("http://127.0.0.1:9/studio", "cannot be reached"),
        ):
            settings_of(**place.settings | {"object_store": address})
            with pytest.raises(CliError, match=says) as refused:
                command()
            assert address.rpartition("/")[0] in str(refused.value)


def test_the_rules_of_the_bucket_are_checked_where_browsers_use_it(place, capsys, settings_of):
    settings_of(**place.settings, object_store_public=place.origin, port=8123)
    with pytest.raises(CliError, match="AllowedOrigins") as refused:
        check()
    rule = '{"CORSRules": [{"AllowedMethods": ["GET"], "AllowedOrigins": ["http://127.0.0.1:8123"]}]}'
    assert rule in refused.value.lines
    rules = [{"AllowedMethods": ["GET"], "AllowedOrigins": ["http://127.0.0.1:8123"]}]
    client = the_store()._client
    client.put_bucket_cors(Bucket=the_store().bucket, CORSConfiguration={"CORSRules": rules})
    assert "CORS rules allow http://127.0.0.1:8123 alone" in said(capsys, check)
