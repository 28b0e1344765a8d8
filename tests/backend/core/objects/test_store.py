"""The store verifies what it stores and reads, and says what failed, where, and what to do."""

from __future__ import annotations

import hashlib
import subprocess
import sys

import pytest
import requests

from backend.core.objects.errors import ObjectMissingError, StoreError
from backend.core.objects.store import PART_BYTES, as_file, new_key, store, the_store, written_store

DATA = bytes(range(256)) * 8192
SHA256 = hashlib.sha256(DATA).hexdigest()


def put(key="blobs/a/1"):
    the_store().put(key, as_file(DATA), len(DATA), SHA256)
    return key


def test_an_object_is_read_whole_in_parts_and_by_range(objects):
    key = put()
    assert the_store().get(key, SHA256) == DATA
    assert the_store().size(key) == len(DATA)
    assert b"".join(the_store().read(key, 5, 9)) == DATA[5:9]
    assert b"".join(the_store().read(key, 7)) == DATA[7:]
    assert list(the_store().read(key, 9, 9)) == []
    assert max(map(len, the_store().read(key))) <= PART_BYTES
    the_store().delete([key, "blobs/none"])
    assert objects.keys() == set()


def test_a_folder_of_the_bucket_is_apart(objects, settings_of):
    objects.put("other")
    settings_of(**objects.settings | {"object_store": objects.settings["object_store"] + "/a/b"})
    key = put()
    assert objects.keys() == {"other", f"a/b/{key}"}
    assert [(one.key, one.size) for one in the_store().listed("")] == [(key, len(DATA))]


def test_other_bytes_than_were_meant_are_refused(objects):
    with pytest.raises(StoreError, match="is not what was stored"):
        the_store().put("a/1", as_file(DATA), len(DATA), "0" * 64)
    assert objects.keys() == set()
    objects.put("a/2", DATA[:-1])
    with pytest.raises(StoreError, match="is not what was stored"):
        the_store().get("a/2", SHA256)


def test_errors_name_the_place_and_what_to_do(objects, settings_of):
    with pytest.raises(ObjectMissingError, match="blobs/none is missing in the bucket “studio” at http"):
        the_store().get("blobs/none", SHA256)
    with pytest.raises(ObjectMissingError):
        the_store().size("blobs/none")
    for address, says in (
        (f"{objects.origin}/nothing", "no such bucket"),
        ("http://127.0.0.1:9/studio", "cannot be reached: no connection"),
    ):
        settings_of(**objects.settings | {"object_store": address})
        with pytest.raises(StoreError, match=says) as raised:
            the_store().require_bucket()
        assert raised.value.hint


def test_wrong_credentials_are_named(objects, settings_of):
    """The server asks for credentials from the second request on."""
    requests.post(f"{objects.origin}/moto-api/reset-auth", data="1", timeout=60)
    the_store().require_bucket()
    with pytest.raises(StoreError, match="the access key is unknown there") as raised:
        the_store().require_bucket()
    assert "BT_STUDIO_OBJECT_STORE_KEY" in raised.value.hint
    requests.post(f"{objects.origin}/moto-api/reset-auth", data="inf", timeout=60)


def test_an_address_is_of_one_object_for_a_minute_and_a_download(objects, settings_of):
    settings_of(**objects.settings, object_store_public=objects.origin)
    address = the_store().address(put(), "ñ.bin")
    answer = requests.get(address, timeout=60)
    assert answer.content == DATA
    assert answer.headers["Content-Type"] == "application/octet-stream"
    assert answer.headers["Content-Disposition"] == "attachment; filename*=UTF-8''%C3%B1.bin"
    assert "X-Amz-Expires=60" in address
    assert address.startswith(f"{objects.origin}/studio/blobs/a/1?")


def test_the_rules_of_the_bucket_admit_one_origin_alone(objects):
    def rule(*origins):
        rules = [{"AllowedMethods": ["GET"], "AllowedOrigins": list(origins)}]
        client = the_store()._client
        client.put_bucket_cors(Bucket=the_store().bucket, CORSConfiguration={"CORSRules": rules})

    assert not the_store().admits("https://bt.example.org")
    rule("*")
    assert not the_store().admits("https://bt.example.org")
    rule("https://bt.example.org")
    assert the_store().admits("https://bt.example.org")


def test_the_settings_say_what_goes_there(objects, settings_of):
    assert written_store(1 << 20) is None
    assert written_store((1 << 20) + 1) is the_store()
    settings_of(**objects.settings, object_store_writes="false")
    assert written_store(1 << 30) is None
    settings_of(object_store="")
    assert store() is None
    with pytest.raises(StoreError, match="this server has none"):
        the_store()


def test_names_are_never_used_twice():
    assert new_key("blobs/", "a") != new_key("blobs/", "a")
    assert new_key("blobs/", "a").startswith("blobs/a/")


def test_the_library_is_loaded_only_where_a_store_is_set():
    program = (
        "import sys, django; django.setup(); import backend.config.urls;"
        "print([name for name in ('boto3', 'botocore', 'storages') if name in sys.modules])"
    )
    environment = {"DJANGO_SETTINGS_MODULE": "backend.config.settings", "PATH": "/usr/bin:/bin"}
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, env=environment, check=True
    )
    assert done.stdout.strip() == "[]"
