"""Names of files between page and server."""

from __future__ import annotations

from typing import Any

import pytest

from backend.language.protocol.addresses import Addresses, ForeignAddressError, path_of

SOURCES = {
    "python": "/opt/lib/python3.11",
    "packages": "/opt/lib/python3.11/site-packages",
    "modules": "/data dir/library-1",
    "modules/tree_gardener": "/repo/tree_gardener",
}
ADDRESSES = Addresses("/data dir/p1/files", SOURCES)


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
            {"targetUri": "file:///opt/lib/python3.11/site-packages/rclpy/node.py"},
            {"uri": "file:///opt/lib/python3.11/os.py"},
            {"uri": "file:///data%20dir/library-1/geometry_msgs/msg/__init__.pyi"},
            {"uri": "file:///repo/tree_gardener/node.py"},
            {"uri": "file:///home/user/secret.py"},
            {"changes": {"file:///data%20dir/p1/files/actions/Go.py": [{"newText": "x"}]}},
        ]
    }
    assert ADDRESSES.outward(answer)["result"] == [
        {"uri": "file:///project/actions/Go.py"},
        {"targetUri": "file:///library/packages/rclpy/node.py"},
        {"uri": "file:///library/python/os.py"},
        {"uri": "file:///library/modules/geometry_msgs/msg/__init__.pyi"},
        {"uri": "file:///library/modules/tree_gardener/node.py"},
        {"uri": "file:///elsewhere/secret.py"},
        {"changes": {"file:///project/actions/Go.py": [{"newText": "x"}]}},
    ]


@pytest.mark.parametrize("label", SOURCES)
def test_the_page_names_a_source_by_its_label(label):
    [real] = ADDRESSES.inward([{"uri": f"file:///library/{label}/a%20b/c.py"}])
    assert path_of(real["uri"]) == f"{SOURCES[label]}/a b/c.py"
    assert ADDRESSES.outward(real) == {"uri": f"file:///library/{label}/a%20b/c.py"}


@pytest.mark.parametrize(
    "uri",
    [
        "file:///library/python/../../../etc/passwd",
        "file:///library/packages/%2e%2e/%2e%2e/secret.py",
        "file:///library/packages//etc/passwd",
        "file:///library/packages/",
        "file:///library/other/a.py",
        "file:///elsewhere/a.py",
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
