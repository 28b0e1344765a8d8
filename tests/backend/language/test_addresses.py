"""Names of files between page and server."""

from __future__ import annotations

from typing import Any

import pytest

from backend.language.addresses import Addresses, ForeignAddressError

ADDRESSES = Addresses("/data dir/p1/files")


def test_a_message_of_the_page_names_real_files_and_its_text_stays():
    text = "file:///project/actions/Go.py"
    message = {"params": {"textDocument": {"uri": text, "text": text}}}
    assert ADDRESSES.inward(message)["params"]["textDocument"] == {
        "uri": "file:///data%20dir/p1/files/actions/Go.py",
        "text": text,
    }


def test_an_answer_names_the_project_and_hides_the_rest_of_the_machine():
    answer = {
        "result": [
            {"uri": "file:///data%20dir/p1/files/actions/Go.py"},
            {"targetUri": "file:///opt/venv/lib/python3.11/site-packages/rclpy/node.py"},
            {"uri": "file:///data%20dir/library-1/geometry_msgs/msg/__init__.pyi"},
            {"changes": {"file:///data%20dir/p1/files/actions/Go.py": [{"newText": "x"}]}},
        ]
    }
    assert ADDRESSES.outward(answer)["result"] == [
        {"uri": "file:///project/actions/Go.py"},
        {"targetUri": "file:///library/rclpy/node.py"},
        {"uri": "file:///library/__init__.pyi"},
        {"changes": {"file:///project/actions/Go.py": [{"newText": "x"}]}},
    ]


@pytest.mark.parametrize(
    "uri",
    [
        "file:///etc/passwd",
        "file:///project/../../etc/passwd",
        "file:///project/%2e%2e/secret_key",
        "file:///project//etc/passwd",
        "file:///project/a%00b.py",
        "file:///projects/a.py",
        "http://elsewhere/a.py",
    ],
)
def test_the_page_names_no_file_outside_its_project(uri):
    with pytest.raises(ForeignAddressError):
        ADDRESSES.inward({"params": {"textDocument": {"uri": uri}}})


def test_a_message_that_is_nested_beyond_reason_is_refused():
    message: dict[Any, Any] = {}
    for _ in range(200):
        message = {"a": message}
    with pytest.raises(ForeignAddressError):
        ADDRESSES.inward(message)
