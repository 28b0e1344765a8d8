"""Messages of the children's channels, as both ends decode them."""

from __future__ import annotations

import msgspec
import pytest

from executor import messages
from executor.child_messages import Fault, FromApplication, ToWorld
from executor.child_messages.common import Pause, event_of, name_of


def test_a_message_is_decoded_by_its_type() -> None:
    raw = msgspec.msgpack.encode(Pause(request="q1"))
    assert msgspec.msgpack.decode(raw, type=ToWorld) == Pause(request="q1")
    assert name_of(Pause()) == "pause"
    with pytest.raises(msgspec.ValidationError):
        msgspec.convert({"type": "no such"}, ToWorld)
    with pytest.raises(msgspec.ValidationError):
        msgspec.convert({"type": "log", "level": "info", "text": 5}, FromApplication)


def test_a_message_becomes_the_event_of_its_fields() -> None:
    fault = event_of(Fault("process", "it died", hint="Run again."), messages.Fault)
    assert fault == messages.Fault("process", "it died", hint="Run again.")
