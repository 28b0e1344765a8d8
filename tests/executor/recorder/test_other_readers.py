"""Other readers decode each topic and each field of our files as ROS and our own reader do."""

from __future__ import annotations

import array
import dataclasses
import importlib
import json
import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from mcap.reader import make_reader
from rclpy.serialization import deserialize_message
from rosbags.highlevel import AnyReader

from executor.recorder.cdr import decode
from executor.recorder.definitions import OURS
from tests.executor.recorder.page import decoded_by_page
from tests.executor.recorder.test_samples import SAMPLES, VERSIONS

if TYPE_CHECKING:
    from pathlib import Path


def plain(value: Any) -> Any:
    """Returns a message or a part of it as plain data; times of ours are whole ns."""
    if hasattr(value, "get_fields_and_field_types"):
        value = {name: getattr(value, name) for name in value.get_fields_and_field_types()}
    elif dataclasses.is_dataclass(value):
        names = [field.name for field in dataclasses.fields(value)]
        # Those in capitals are constants of the type.
        value = {n: getattr(value, n) for n in names if not (n.isupper() and len(n) > 1) and n[0] != "_"}
    if isinstance(value, dict):
        return {name: plain(item) for name, item in value.items()}
    if isinstance(value, (bytes, bytearray, array.array, np.ndarray, list, tuple)):
        return [plain(item) for item in value]
    value = value.item() if isinstance(value, np.generic) else value
    return None if isinstance(value, float) and not math.isfinite(value) else value  # JSON has no others


def expected(kind: str, data: bytes) -> Any:
    """Returns the fields of a message: of our types as our reader decodes them, of others as ROS does."""
    if kind.startswith(OURS):
        fields = decode(kind, data)
        times = {name: divmod(fields[name], 1_000_000_000) for name in ("stamp", "moment") if name in fields}
        return plain(fields | {name: {"sec": sec, "nanosec": ns} for name, (sec, ns) in times.items()})
    package, _, name = kind.split("/")
    return plain(deserialize_message(data, getattr(importlib.import_module(f"{package}.msg"), name)))


def messages_of(path: Path) -> list[tuple[str, int, Any]]:
    with path.open("rb") as file:
        return [
            (channel.topic, message.log_time, expected(schema.name, message.data))
            for schema, channel, message in make_reader(file).iter_messages()
            if schema is not None
        ]


@pytest.mark.parametrize("version", VERSIONS)
def test_rosbags_reads_each_field(version: int) -> None:
    path = SAMPLES / f"v{version}.mcap"
    with AnyReader([path]) as reader:
        found = [(c.topic, t, plain(reader.deserialize(data, c.msgtype))) for c, t, data in reader.messages()]
    was = messages_of(path)
    assert len(found) == len(was)
    assert sorted(found, key=repr) == sorted(was, key=repr)


@pytest.mark.parametrize("version", VERSIONS)
def test_the_page_reads_each_field(version: int) -> None:
    """By `@mcap/core` and the definitions in the file, in Node with the modules of the page's worker.

    In Chromium the same modules are tested by `tests/e2e/test_axis.py`. Their numbers have 53 bits.
    """
    path = SAMPLES / f"v{version}.mcap"
    was = json.loads(json.dumps(messages_of(path)))
    found = decoded_by_page(path)
    assert [topic for topic, _, _ in found] == [topic for topic, _, _ in was]
    for (topic, _, fields), (_, _, shown) in zip(was, found, strict=True):
        assert rounded(shown) == rounded(fields), topic


def rounded(value: Any) -> Any:
    """Returns data with numbers as the page has them: floats of JavaScript."""
    if isinstance(value, dict):
        return {name: rounded(item) for name, item in value.items()}
    if isinstance(value, list):
        return [rounded(item) for item in value]
    return float(value) if isinstance(value, int) else value
