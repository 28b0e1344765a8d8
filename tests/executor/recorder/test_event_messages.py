"""Events that become lines of a recording."""

from __future__ import annotations

import json

import pytest

from executor.recorder.event_messages import STEP_HZ, input_fields, message_of


@pytest.mark.parametrize(
    ("name", "data", "line"),
    [
        ("log", {"source": "action", "level": "error", "text": "x"}, ("action", "error", "x")),
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


def test_a_flag_has_its_own_moment_and_a_stop_is_a_gap():
    flag = {"run": "r", "id": "f1", "t": 1.5, "text": "here", "user": "ada"}
    assert message_of("flag", 5, flag, 0) == (
        "/bt/flag",
        "Flag",
        {"stamp": 5, "moment": 1_500_000_000, "id": "f1", "text": "here", "user": "ada"},
    )
    stop = {"run": "r", "t": 1.0, "reason": "recorder_died", "detail": "was killed", "goes_on": True}
    assert message_of("recording_stopped", 5, stop, 0) == (
        "/bt/gap",
        "Gap",
        {"stamp": 5, "reason": "recorder_died", "text": "was killed"},
    )


def test_what_a_person_did_has_its_place():
    done = input_fields(0.5, "teleop", {"linear": 0.1}, None)
    assert (done["stamp"], done["step"], done["tick"], done["hook"]) == (5 * 10**8, STEP_HZ / 2, None, -1)
    assert (done["command"], json.loads(done["data_json"])) == ("teleop", {"linear": 0.1})
    held = input_fields(-1.0, "force", {}, 7, 2)
    assert (held["stamp"], held["tick"], held["hook"]) == (0, 7, 2)


def test_large_data_of_an_input_are_a_preview():
    done = input_fields(0.0, "publish_topic", {"message": {"data": "x" * 10_000}}, 1)
    shown = json.loads(done["data_json"])
    assert shown["bytes"] > 10_000
    assert len(done["data_json"]) < 1000
