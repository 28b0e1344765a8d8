"""When a host is lost: after 30 s of failed looks, and never because nobody looked."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from backend.sessions.hosts.contact import LOST_S, Contact

LOOKS = st.lists(st.tuples(st.floats(0, 100), st.booleans()))


def test_a_host_is_lost_after_half_a_minute_of_looks_without_an_answer():
    contact = Contact()
    contact.heard(100.0)
    for now_s in (105.0, 115.0, 125.0):
        contact.missed(now_s)
        assert not contact.is_lost
    contact.missed(130.0)
    assert contact.is_lost
    assert contact.heard(131.0)
    assert not contact.is_lost
    assert not contact.heard(136.0)


def test_a_server_that_did_not_look_has_missed_nothing():
    contact = Contact()
    contact.heard(0.0)
    contact.missed(20.0)
    contact.missed(1000.0)  # it was stopped, or another server maintained the sessions
    assert not contact.is_lost
    contact.missed(1010.0)
    assert not contact.is_lost


@given(LOOKS)
def test_a_host_is_only_lost_after_that_time_and_is_found_by_one_answer(looks):
    contact, now_s, heard_s = Contact(), 0.0, 0.0
    for pause_s, is_answered in looks:
        now_s += pause_s
        if is_answered:
            contact.heard(now_s)
            heard_s = now_s
            assert not contact.is_lost
        else:
            contact.missed(now_s)
        assert not contact.is_lost or now_s - heard_s >= LOST_S
