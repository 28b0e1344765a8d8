"""Messages of Groot2's protocol: their bytes, and what is refused."""

from __future__ import annotations

import contextlib
import json
import struct
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tree_gardener import Status
from tree_gardener.groot.protocol import (
    MOST_HOOKS,
    GrootError,
    Header,
    HookKey,
    Mode,
    Position,
    RequestType,
    pack_statuses,
    pack_transition,
    read_hooks,
    read_key,
    read_unlock,
    wire_status,
)


def as_bytes(document: Any) -> bytes:
    return json.dumps(document).encode()


HOOK = {"enabled": True, "uid": 3, "mode": 1, "once": False, "desired_status": "FAILURE", "position": 1}


def test_a_header_is_six_bytes() -> None:
    header = Header(RequestType.STATUS, 0x01020304)
    assert header.pack() == b"\x02S\x04\x03\x02\x01"
    assert Header.read(header.pack()) == header


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (b"", "wrong request header"),
        (bytes(7), "wrong request header"),
        (struct.pack("<BBI", 1, ord("S"), 0), "protocol 1"),
        (struct.pack("<BBI", 2, ord("z"), 0), "not recognized"),
    ],
)
def test_other_headers_are_refused(data: bytes, text: str) -> None:
    with pytest.raises(GrootError, match=text):
        Header.read(data)


def test_statuses_and_transitions_are_little_endian() -> None:
    assert pack_statuses([(1, 2), (0x0102, 14)]) == b"\x01\x00\x02\x02\x01\x0e"
    assert pack_transition(0x010203040506, 0x0102, Status.FAILURE) == b"\x06\x05\x04\x03\x02\x01\x02\x01\x03"


def test_a_node_that_became_idle_is_sent_with_what_it_was() -> None:
    assert wire_status(Status.RUNNING, 0) == 1
    assert [wire_status(Status.IDLE, before) for before in (0, 1, 2, 3, 12)] == [0, 11, 12, 13, 12]


def test_hooks_are_read_one_or_many() -> None:
    (hook,) = read_hooks(json.dumps(HOOK).encode())
    assert hook.key == HookKey(3, Position.AFTER)
    assert hook.mode is Mode.REPLACE
    assert hook.to_json() == HOOK
    assert len(read_hooks(json.dumps([HOOK, HOOK]).encode())) == 2


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"uid": "3"}, "'uid'"),
        ({"uid": True}, "'uid'"),
        ({"mode": 2}, "'mode'"),
        ({"position": None}, "'position'"),
        ({"once": 1}, "'once'"),
        ({"enabled": "yes"}, "'enabled'"),
        ({"desired_status": "DONE"}, "'desired_status'"),
        ({"desired_status": []}, "'desired_status'"),
    ],
)
def test_a_wrong_field_is_named(change: dict[str, Any], text: str) -> None:
    with pytest.raises(GrootError, match=text):
        read_hooks(json.dumps(HOOK | change).encode())


def test_too_many_hooks_are_refused() -> None:
    with pytest.raises(GrootError, match=str(MOST_HOOKS)):
        read_hooks(json.dumps([HOOK] * (MOST_HOOKS + 1)).encode())


@given(st.binary(max_size=200) | st.recursive(st.none() | st.integers() | st.text(), st.lists).map(as_bytes))
def test_any_content_is_read_or_refused_with_a_sentence(data: bytes) -> None:
    for read in (read_hooks, read_key, read_unlock):
        with contextlib.suppress(GrootError):
            assert read(data) is not None
