"""Bytes that are held for readers of answers."""

from __future__ import annotations

import pytest

from backend.core.readers import SMALL, Readers, ReadersBusyError, Reading, readers, reading, reserve

OWN, ALL = 10 * SMALL, 30 * SMALL


def test_an_owner_and_all_owners_together_have_a_limit():
    them = Readers(OWN, ALL)
    held = [them.take("olga", 5 * SMALL) for _ in range(2)]
    with pytest.raises(ReadersBusyError, match="your other requests") as refused:
        them.take("olga", SMALL + 1)
    assert refused.value.headers == {"Retry-After": "5"}
    held += [them.take(who, 10 * SMALL) for who in ("otto", "fred")]
    with pytest.raises(ReadersBusyError, match="to other requests"):
        them.take("eve", SMALL + 1)
    held[0].close()
    held[0].close()
    assert them.total == 25 * SMALL
    held += [them.take("olga", 5 * SMALL)]
    for one in held:
        one.close()
    assert them.total == 0


def test_one_answer_passes_whatever_its_size_and_small_ones_and_those_to_writes_always_do():
    them = Readers(OWN, ALL)
    held = [them.take("olga", 100 * SMALL)]
    held += [them.take("olga", SMALL), them.take("olga", 2 * SMALL, must=True)]
    assert them.total == 103 * SMALL
    for one in held:
        one.close()
    assert them.total == 0


def test_an_answer_whose_size_was_estimated_is_counted_by_its_size():
    them = Readers(None, ALL)
    held = them.take("olga", ALL)
    held.resize(SMALL)
    assert them.total == SMALL
    them.take("olga", ALL - SMALL).close()
    held.close()
    assert them.total == 0


TEAM = {
    "mode": "team",
    "public_url": "https://bt.example.org",
    "database_url": "sqlite:////x/y",
    "secret_key": "x" * 40,
}


def test_the_limits_are_settings_and_only_teams_have_one_for_each_owner(settings_of):
    settings_of(max_unread_bytes_per_owner=SMALL, max_unread_bytes=ALL)
    first, second = Reading("olga"), Reading("olga")
    first.reserve(20 * SMALL)
    second.reserve(10 * SMALL)
    with pytest.raises(ReadersBusyError):
        second.reserve(2 * SMALL)
    first.close()
    second.close()
    assert readers().total == 0
    settings_of(max_unread_bytes_per_owner=SMALL, unsafe_users_run_as_server="true", **TEAM)
    first.reserve(20 * SMALL)
    with pytest.raises(ReadersBusyError, match="your other"):
        second.reserve(2 * SMALL)


def test_what_a_request_holds_already_is_not_what_it_waits_for(settings_of):
    settings_of(
        max_unread_bytes_per_owner=OWN, max_unread_bytes=ALL, unsafe_users_run_as_server="true", **TEAM
    )
    one, other, of_another = Reading("olga"), Reading("olga"), Reading("otto")
    one.reserve(20 * SMALL)
    one.reserve(20 * SMALL)
    with pytest.raises(ReadersBusyError, match="your other"):
        other.reserve(2 * SMALL)
    with pytest.raises(ReadersBusyError, match="to other requests"):
        of_another.reserve(2 * SMALL)
    of_another.reserve(SMALL)
    with pytest.raises(ReadersBusyError, match="to other requests"):
        one.reserve(2 * SMALL)
    one.close()
    of_another.close()
    assert readers().total == 0


def test_a_request_counts_what_it_fetches_and_then_its_answer(settings_of):
    settings_of(max_unread_bytes=ALL)
    one, other = Reading("olga"), Reading("otto")
    token = reading.set(one)
    reserve(5 * SMALL)
    reserve(15 * SMALL)
    reading.reset(token)
    reserve(100 * SMALL)  # of no request
    assert readers().total == 20 * SMALL
    one.settle(25 * SMALL, must=False)
    assert readers().total == 25 * SMALL
    with pytest.raises(ReadersBusyError):
        other.settle(6 * SMALL, must=False)
    other.settle(6 * SMALL, must=True)
    one.close()
    one.close()
    other.close()
    assert readers().total == 0
