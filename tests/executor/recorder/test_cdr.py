"""Our messages as CDR, against an independent reader."""

from __future__ import annotations

import numpy as np
import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from executor.recorder.cdr import CdrError, decode, encode
from executor.recorder.definitions import OURS, full_text, names_of_ours
from tests.executor.recorder.messages import MESSAGES, T_NS


def test_every_type_has_an_example():
    assert {f"{OURS}/msg/{name}" for name in MESSAGES} == set(names_of_ours())


@pytest.mark.parametrize("name", MESSAGES)
def test_another_reader_finds_every_field(name):
    kind = f"{OURS}/msg/{name}"
    store = get_typestore(Stores.ROS2_JAZZY)
    text = full_text(kind).partition("=" * 80)[0]
    store.register(get_types_from_msg(text, kind))
    read = store.deserialize_cdr(encode(kind, MESSAGES[name]), kind)
    for field, value in MESSAGES[name].items():
        found = getattr(read, field)
        if field == "stamp":
            assert (found.sec, found.nanosec) == divmod(T_NS, 10**9)
        elif isinstance(found, np.ndarray):
            assert found.tolist() == list(value), field
        else:
            assert found == value, field


@pytest.mark.parametrize("name", MESSAGES)
def test_a_message_comes_back(name):
    kind = f"{OURS}/msg/{name}"
    assert decode(kind, encode(kind, MESSAGES[name])) == MESSAGES[name]


@pytest.mark.parametrize("name", MESSAGES)
def test_a_cut_message_is_an_error_at_every_byte(name):
    kind = f"{OURS}/msg/{name}"
    data = encode(kind, MESSAGES[name])
    for length in range(len(data)):
        with pytest.raises(CdrError, match=kind):
            decode(kind, data[:length])


def test_a_list_that_claims_more_than_the_message_holds_is_refused():
    kind = f"{OURS}/msg/Poses"
    data = bytearray(encode(kind, MESSAGES["Poses"]))
    data[12:16] = b"\xff\xff\xff\x7f"
    with pytest.raises(CdrError, match="a list of 2147483647 items"):
        decode(kind, bytes(data))
