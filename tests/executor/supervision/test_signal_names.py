"""The end of a process can be said for every signal."""

from __future__ import annotations

import signal

import pytest

from executor.supervision.signal_names import how_ended, signal_name


def test_every_signal_can_be_said() -> None:
    assert signal_name(signal.SIGKILL) == "SIGKILL"
    assert signal_name(signal.SIGRTMIN + 6) == f"signal {signal.SIGRTMIN + 6}"
    assert all(map(signal_name, range(1, signal.NSIG)))


@pytest.mark.parametrize(
    ("code", "words"),
    [
        (3, "ended with exit code 3"),
        (-signal.SIGKILL, "was ended at once, as the system does when memory runs out"),
        (-signal.SIGSEGV, "crashed: Segmentation fault"),
        (-signal.SIGTERM, "was ended: Terminated"),
    ],
)
def test_users_read_words_and_no_names_of_signals(code: int, words: str) -> None:
    assert how_ended(code) == words


def test_every_end_can_be_said() -> None:
    assert all("SIG" not in how_ended(-number) for number in range(1, signal.NSIG))
