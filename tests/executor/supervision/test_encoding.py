"""Messages to other processes are written whatever a user's value puts into them."""

from __future__ import annotations

import contextlib
import io

import msgspec
import numpy as np
import pytest

from executor.application.preview import preview, text_of
from executor.child_messages import Blackboard, Log, decode_from_application
from executor.messages import BlackboardEntry
from executor.recorder.values import canonical, value_json
from executor.supervision.encoding import encode_message
from tests.fakes.hostile_values import VALUES, Real, Text, Whole


@pytest.mark.parametrize("number", range(len(VALUES)))
def test_any_value_can_be_sent_as_it_is(number: int) -> None:
    message = Blackboard([BlackboardEntry("", "key", "any", VALUES[number])])
    with contextlib.redirect_stdout(io.StringIO()):
        data = encode_message(message)
    assert isinstance(decode_from_application(data), Blackboard)


@pytest.mark.parametrize("number", range(len(VALUES)))
def test_any_value_has_a_preview_and_a_form_in_recordings(number: int) -> None:
    with contextlib.redirect_stdout(io.StringIO()):
        shown, _ = preview(VALUES[number])
        form = canonical(VALUES[number])
        recorded = value_json(VALUES[number], text_of)
    msgspec.json.encode(shown)
    assert form is None or form.encode()
    msgspec.json.decode(recorded)


def test_numbers_and_texts_of_derived_classes_arrive_as_what_they_are() -> None:
    for value, plain in ((np.float64(1.5), 1.5), (Real(2.5), 2.5), (Whole(7), 7), (Text("a"), "a")):
        entry = BlackboardEntry("", Text("key"), "any", value)
        got = decode_from_application(encode_message(Blackboard([entry])))
        assert isinstance(got, Blackboard)
        assert (got.entries[0].key, got.entries[0].value) == ("key", plain)


def test_half_a_character_is_written_as_its_number() -> None:
    got = decode_from_application(encode_message(Log("info", "a \ud800 b")))
    assert isinstance(got, Log)
    assert got.text == "a \\ud800 b"
