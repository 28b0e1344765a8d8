import pytest

from tree_gardener import Status
from tree_gardener.debugging import DebuggingEnded, Event, Stop


@pytest.mark.parametrize(
    ("event", "status", "decided", "what"),
    [
        (Event.BEFORE, None, "", "before its tick"),
        (Event.AFTER, Status.RUNNING, "", "it returned RUNNING"),
        (Event.DECIDED, Status.SKIPPED, "_while", "_while decided SKIPPED"),
        (Event.HALTED, None, "", "it was halted"),
    ],
)
def test_a_stop_says_what_happens(event: Event, status: Status, decided: str, what: str) -> None:
    assert Stop(event, 2, "a", 1, status, decided, "step", (1, 2), ()).what == what


def test_the_end_of_debugging_is_no_exception_that_users_catch() -> None:
    assert not issubclass(DebuggingEnded, Exception)
