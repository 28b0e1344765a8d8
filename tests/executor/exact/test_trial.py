"""The witness of a continuation, and the end that follows from it."""

from __future__ import annotations

from typing import Any

import pytest

from executor import child_messages, messages
from executor.exact.trial import HELD, Witness, end_of

FAULT = child_messages.Fault("exception", "boo", node_path="Act::1", file="actions/Act.py", line=7)
REFUSAL = child_messages.Answer(error=messages.Error("bad_port", "No.", "Yes."))
DONE = child_messages.Finished("SUCCESS", "root_finished")


@pytest.mark.parametrize(
    ("said", "is_over", "end", "text"),
    [
        ([], True, "running", ""),
        ([], False, "held", HELD),
        ([DONE], False, "finished", "The tree ended with SUCCESS."),
        ([FAULT, DONE], False, "fault", "actions/Act.py:7: Act::1: boo"),
        (
            [child_messages.Answer(error=messages.Error("bad_port", "No.", "Yes."))],
            True,
            "refused",
            "No. Yes.",
        ),
        ([child_messages.Answer()], True, "running", ""),
    ],
)
def test_the_end_of_a_continuation(said: list[Any], is_over: bool, end: str, text: str) -> None:
    witness = Witness()
    for message in said:
        witness.send(message)
    assert end_of(witness, is_over=is_over) == (end, text)


def test_the_first_fault_and_all_fingerprints_are_kept() -> None:
    witness = Witness()
    for data in (b"12345678", b"abcdefgh"):
        witness.send(child_messages.Fingerprints(data))
        witness.send(child_messages.Fault("exception", data.decode()))
    assert bytes(witness.prints) == b"12345678abcdefgh"
    assert witness.fault is not None
    assert witness.fault.message == "12345678"
    assert witness.flush(1.0)
