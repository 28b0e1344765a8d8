"""Every error of the library becomes one sentence with a hint, and shows no text of the other side."""

from __future__ import annotations

import pytest
from botocore import exceptions

from backend.core.objects.errors import ObjectMissingError, StoreError, damaged, explained, not_configured


def refused(code):
    return exceptions.ClientError({"Error": {"Code": code, "Message": "<b>text</b>"}}, "GetObject")


@pytest.mark.parametrize(
    ("error", "says"),
    [
        (refused("NoSuchBucket"), "there is no such bucket"),
        (refused("AccessDenied"), "access is denied"),
        (refused("SignatureDoesNotMatch"), "the secret does not fit"),
        (refused("SlowDown"), "refuses: SlowDown"),
        (refused("<script>"), "refuses: an unknown error"),
        (exceptions.NoCredentialsError(), "no credentials"),
        (exceptions.ConnectTimeoutError(endpoint_url="x"), "no connection within 5 s"),
        (exceptions.IncompleteReadError(actual_bytes=1, expected_bytes=2), "the connection broke"),
        (ConnectionResetError("gone"), "the connection broke"),
    ],
)
def test_what_failed_where_and_what_to_do(error, says):
    with pytest.raises(StoreError, match=says) as raised, explained("the bucket “b”"):
        raise error
    assert "the bucket “b”" in raised.value.detail
    assert raised.value.hint
    assert "text" not in raised.value.detail


def test_an_absent_object_is_no_absent_bucket():
    with pytest.raises(ObjectMissingError), explained("here", "blobs/a"):
        raise refused("NoSuchKey")
    with pytest.raises(StoreError, match="no such bucket"), explained("here"):
        raise refused("404")


def test_the_others_say_what_to_do():
    assert "BT_STUDIO_OBJECT_STORE" in not_configured().hint
    assert "backup" in damaged("blobs/a", "here").hint
