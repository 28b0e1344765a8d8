"""Which flags a client can set, change and remove."""

from __future__ import annotations

import pytest

from executor.messages import Flag, FlagSet
from executor.session.runs.recording import MOST_FLAGS, FlagRefused, flag_of

OLD = FlagSet("r", "f1", 2.0, "old", "ada")


def test_a_new_flag_is_at_the_present_or_at_a_moment_of_the_past():
    now = flag_of(Flag(" here "), {}, "r", 5.0)
    assert (now.run, now.t, now.text) == ("r", 5.0, "here")
    past = flag_of(Flag("here", t=1.5, user="bob", run="r"), {}, "r", 5.0)
    assert (past.t, past.user) == (1.5, "bob")
    assert now.id != past.id
    assert flag_of(Flag("here", t=9.0), {}, "r", 5.0).t == 5.0


def test_a_change_keeps_what_it_does_not_name():
    changed = flag_of(Flag("new", id="f1"), {"f1": OLD}, "r", 5.0)
    assert changed == FlagSet("r", "f1", 2.0, "new", "ada")
    moved = flag_of(Flag("new", id="f1", t=3.0, user="bob"), {"f1": OLD}, "r", 5.0)
    assert (moved.t, moved.user) == (3.0, "bob")
    assert flag_of(Flag("  ", id="f1"), {"f1": OLD}, "r", 5.0).text == ""


@pytest.mark.parametrize(
    ("wanted", "code"),
    [
        (Flag("x", run="other"), "not_present"),
        (Flag("x", id="gone"), "unknown_flag"),
        (Flag("  "), "no_text"),
    ],
)
def test_others_are_refused(wanted, code):
    with pytest.raises(FlagRefused) as refused:
        flag_of(wanted, {"f1": OLD}, "r", 5.0)
    assert refused.value.code == code


def test_a_run_has_at_most_so_many_flags_but_those_can_be_changed():
    full = {str(at): FlagSet("r", str(at), 1.0, "x") for at in range(MOST_FLAGS)}
    with pytest.raises(FlagRefused) as refused:
        flag_of(Flag("one more"), full, "r", 5.0)
    assert refused.value.code == "too_many"
    assert flag_of(Flag("y", id="7"), full, "r", 5.0).text == "y"
