"""Messages of the Debug Adapter Protocol as the session checks and changes them."""

from __future__ import annotations

from typing import Any

import pytest

from executor.session.debugger.dap import ALLOWED, MOST_BYTES, OWN_SEQ, Refused, checked, made_by_hand, named


def request(command: Any = "threads", seq: Any = 1, **arguments: Any) -> dict[str, Any]:
    return {"type": "request", "seq": seq, "command": command, "arguments": arguments}


def test_a_request_keeps_what_it_has():
    found = checked(request("variables", 7, variablesReference=3), "/run")
    assert (found.seq, found.command, found.arguments) == (7, "variables", {"variablesReference": 3})
    assert checked({"type": "request", "seq": 1, "command": "threads"}, "/run").arguments == {}


def test_files_are_those_of_the_run():
    wanted = request("setBreakpoints", source={"path": "actions/Turn.py", "name": "x"}, breakpoints=[])
    assert checked(wanted, "/run/1").arguments == {
        "source": {"path": "/run/1/actions/Turn.py"},
        "breakpoints": [],
    }
    answer = {
        "body": {"stackFrames": [{"source": {"path": "/run/1/actions/Turn.py"}}, {"path": "/usr/x.py"}]}
    }
    assert named(answer, "/run/1") == {
        "body": {"stackFrames": [{"source": {"path": "actions/Turn.py"}}, {"path": "/usr/x.py"}]}
    }


@pytest.mark.parametrize(
    ("message", "code"),
    [
        (request("launch"), "not_allowed"),
        (request("attach"), "not_allowed"),
        (request("runInTerminal"), "not_allowed"),
        (request("debugpySystemInfo"), "not_allowed"),
        (request("source"), "not_allowed"),
        (request(3), "bad_data"),
        (request(seq=0), "bad_data"),
        (request(seq=True), "bad_data"),
        (request(seq=OWN_SEQ), "bad_data"),
        (request() | {"type": "response"}, "bad_data"),
        (request() | {"arguments": [1]}, "bad_data"),
        ({}, "bad_data"),
        (request("evaluate", expression="x" * MOST_BYTES), "too_large"),
        (request("setBreakpoints", source={"path": "/etc/passwd"}), "bad_path"),
        (request("setBreakpoints", source={"path": "a/../../x.py"}), "bad_path"),
        (request("setBreakpoints", source={"path": "a\0.py"}), "bad_path"),
        (request("setBreakpoints", source={"sourceReference": 1}), "bad_path"),
        (request("setBreakpoints", source={"path": ""}), "bad_path"),
        (request("setBreakpoints", source="x"), "bad_path"),
    ],
)
def test_what_is_refused(message: dict[str, Any], code: str):
    with pytest.raises(Refused) as refused:
        checked(message, "/run")
    assert refused.value.code == code
    assert refused.value.message.endswith(".")


def test_nothing_that_starts_programs_is_allowed():
    assert ALLOWED.isdisjoint(
        {"launch", "attach", "runInTerminal", "debugpySystemInfo", "terminate", "source"}
    )


@pytest.mark.parametrize(
    ("wanted", "change"),
    [
        (request("variables", variablesReference=1), ""),
        (request("setVariable", name="n", value="3"), "n = 3"),
        (request("evaluate", expression="self.n = 2", context="repl"), "self.n = 2"),
        (request("evaluate", expression="n", context="repl"), "n"),
        (request("evaluate", expression="n"), "n"),
        (request("evaluate", expression="self.n", context="hover"), ""),
        (request("evaluate", expression="a['x'][-1].y", context="watch"), ""),
        (request("evaluate", expression="f()", context="watch"), "f()"),
        (request("evaluate", expression="a[f()]", context="hover"), "a[f()]"),
        (request("evaluate", expression="(n := 3)", context="watch"), "(n := 3)"),
    ],
)
def test_what_changes_a_program_by_hand(wanted: dict[str, Any], change: str):
    assert made_by_hand(checked(wanted, "/run")) == change


def test_an_answer_that_is_nested_too_deeply_is_cut():
    deep: dict[str, Any] = {"path": "/run/a.py"}
    for _ in range(100):
        deep = {"x": deep}
    assert "/run/a.py" not in str(named(deep, "/run"))
