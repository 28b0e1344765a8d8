"""Addresses of buckets: what is none is refused with the name of its variable."""

from __future__ import annotations

import pytest

from backend.config.environment import InvalidEnvironmentError, environment
from backend.config.object_store import ObjectStoreSettings


def test_a_bucket_has_an_address_and_a_folder(settings_of):
    settings_of(object_store="https://s3.example.org:9000/studio/one/", object_store_public="https://F.org")
    assert environment().object_store == "https://s3.example.org:9000/studio/one"
    assert environment().object_store_public == "https://f.org"
    assert ObjectStoreSettings.model_fields["object_store"].default == ""


@pytest.mark.parametrize(
    ("variable", "value"),
    [
        ("object_store", "s3.example.org/studio"),
        ("object_store", "ftp://s3.example.org/studio"),
        ("object_store", "https://key:secret@s3.example.org/studio"),
        ("object_store", "https://s3.example.org"),
        ("object_store", "https://s3.example.org/STUDIO"),
        ("object_store", "https://s3.example.org/studio/../other"),
        ("object_store", "https://s3.example.org/studio?x=1"),
        ("object_store_public", "https://files.example.org/path"),
        ("object_store_public", "https://files.example.org; script-src *"),
        ("object_store_public", "files.example.org"),
        ("object_store_key", "a key without its secret"),
    ],
)
def test_what_is_none_is_refused(settings_of, variable, value):
    settings_of(**{variable: value})
    with pytest.raises(InvalidEnvironmentError, match=f"BT_STUDIO_{variable.upper()}"):
        environment()
