"""Places that workers share, and in which no owner keeps all others waiting."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from backend.core.processes.fair_places import FairPlaces, Share, Turn
from backend.core.processes.siblings import PLACES, Family, siblings

SHARE = Share(most=3, own=2, own_waiting=2)


@pytest.fixture(params=["alone", "workers"])
def places(request, tmp_path, monkeypatch):
    """The places as two workers see them; a server without workers has one view."""
    if request.param == "alone":
        found = FairPlaces("robots")
        return found, found
    (tmp_path / PLACES).mkdir()
    monkeypatch.setattr(siblings, "family", Family(tmp_path, 2, 0))
    return FairPlaces("robots"), FairPlaces("robots")


def test_the_next_place_goes_to_who_has_the_fewest(places):
    here, there = places
    ada = [here.enter("ada", SHARE) for _ in range(4)]
    assert [one.turn() for one in ada] == [None, None, Turn(0, is_own=True), Turn(1, is_own=True)]
    assert here.enter("ada", SHARE) is None
    ben = [there.enter("ben", SHARE) for _ in range(2)]
    eva = here.enter("eva", SHARE)
    assert [one.turn() for one in (*ben, eva)] == [None, Turn(1, is_own=False), Turn(0, is_own=False)]
    ada[0].give_back()
    assert eva.turn() is None
    # Ada and ben have one each, and she has waited longer.
    assert [ada[2].turn(), ben[1].turn()] == [Turn(0, is_own=False), Turn(1, is_own=False)]
    eva.give_back()
    eva.give_back()
    assert [ada[2].turn(), ada[3].turn(), ben[1].turn()] == [
        None,
        Turn(1, is_own=True),
        Turn(0, is_own=False),
    ]


def test_the_last_wish_of_an_owner_about_something_is_found(places):
    here, there = places
    held = [here.enter("ada", SHARE, about="one") for _ in range(2)]
    assert there.turn_of("ada", SHARE, about="one") is None
    flo = there.enter("flo", SHARE, about="one")
    here.enter("ada", SHARE, about="one")
    here.enter("ada", SHARE, about="two")
    there.enter("eva", SHARE, about="one")
    assert there.turn_of("ada", SHARE, about="one") == Turn(1, is_own=True)
    assert here.turn_of("ada", SHARE, about="two") == Turn(2, is_own=True)
    assert here.turn_of("eva", SHARE, about="one") == Turn(0, is_own=False)
    assert here.turn_of("eva", SHARE, about="two") is None
    held[0].give_back()
    assert there.turn_of("eva", SHARE, about="one") is None  # it was given the place just now
    assert there.turn_of("ada", SHARE, about="one") == Turn(0, is_own=False)
    flo.give_back()
    assert there.turn_of("ada", SHARE, about="one") is None


def test_an_owner_ends_what_is_about_something_also_from_another_worker(places):
    here, there = places
    held, waiting, other = (here.enter("ada", SHARE, about=about) for about in ("one", "one", "two"))
    last = here.enter("ada", Share(3, own=2), about="one")
    bens = there.enter("ben", SHARE, about="one")
    assert not there.end("eva", about="one")
    assert not there.end("ada", about="on")
    assert there.end("ada", about="one")
    assert [one.is_ended() for one in (held, waiting, other, last, bens)] == [True, True, False, True, False]
    assert last.turn() is None
    assert other.turn() == Turn(0, is_own=True)  # what was ended holds its place until it is given back
    assert not there.end("ada", about="one")
    for one in (held, waiting, last):
        one.give_back()
    assert not held.is_ended()
    assert other.turn() is None


def test_a_demonstration_has_no_limit_and_goes_first(places):
    here, there = places
    held = [here.enter("ada", SHARE), here.enter("ben", SHARE), there.enter("eva", SHARE)]
    flo = here.enter("flo", SHARE)
    shown = [there.enter("tina", SHARE, is_exempt=True) for _ in range(4)]
    assert [one.turn().before for one in (*shown, flo)] == [0, 1, 2, 3, 4]
    for one in held:
        one.give_back()
    assert [one.turn() for one in shown[:3]] == [None] * 3
    assert flo.turn() == Turn(1, is_own=False)


def test_who_stops_waiting_is_forgotten_and_without_places_all_are_refused(places):
    here, _ = places
    first, second = here.enter("ada", Share(1)), here.enter("ben", Share(1))
    third = here.enter("eva", Share(1))
    second.give_back()
    assert third.turn() == Turn(0, is_own=False)
    first.give_back()
    assert third.turn() is None
    assert here.enter("ada", Share(0)) is None


def test_a_killed_worker_holds_nothing(tmp_path, monkeypatch):
    (tmp_path / PLACES).mkdir()
    monkeypatch.setattr(siblings, "family", Family(tmp_path, 2, 0))
    here = FairPlaces("robots")
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as other:
        here.enter("ben", Share(1))
        with here.board() as board:
            for row in board["held"].values():
                row[-2:] = [other.pid, json.loads(json.dumps(_started(other.pid)))]
        ada = here.enter("ada", Share(1))
        assert ada.turn() == Turn(0, is_own=False)
        other.kill()
        other.wait()
        assert ada.turn() is None


def _started(pid):
    import psutil

    return psutil.Process(pid).create_time()
