"""Events that become lines of a recording."""

from __future__ import annotations

import pytest

from executor.recorder.event_messages import message_of


@pytest.mark.parametrize(
    ("name", "data", "line"),
    [
        ("log", {"source": "action", "level": "error", "text": "x"}, ("action", "error", "x")),
        ("flag", {"text": "here"}, ("flag", "info", "here")),
        ("finished", {"status": "SUCCESS"}, ("session", "info", "The tree ended with SUCCESS.")),
        ("finished", {"status": "IDLE", "message": "It died."}, ("session", "info", "It died.")),
    ],
)
def test_a_line(name, data, line):
    found = message_of(name, 5, data, 2)
    assert found is not None
    topic, kind, fields = found
    assert (topic, kind) == ("/bt/log", "Log")
    assert (fields["source"], fields["level"], fields["text"]) == line
    assert (fields["stamp"], fields["uid"]) == (5, 2)


def test_a_fault_has_its_place():
    found = message_of("fault", 5, {"kind": "exception", "message": "m", "file": "a.py", "line": 3}, 1)
    assert found == (
        "/bt/fault",
        "Fault",
        {"kind": "exception", "file": "a.py", "message": "m", "traceback": ""}
        | {"stamp": 5, "line": 3, "uid": 1},
    )


def test_other_events_have_no_line():
    assert message_of("sim", 5, {}, 0) is None
