"""Tests with Python that wait for a place."""

from __future__ import annotations

import threading
from functools import partial
from uuid import UUID

import pytest

from backend.core.processes.fair_places import Turn
from backend.core.processes.stops import Stop
from backend.language import turns
from backend.language.errors import CheckerUnavailableError, TestsEndedError
from backend.language.turns import InTurn, turn_of
from backend.workers.aside import checkers
from backend.workers.errors import BusyError
from tests.backend.config.test_team import WHOLE
from tests.deadline import wait_until

pytestmark = pytest.mark.django_db(transaction=True)
PROJECT, OTHER = UUID(int=1), UUID(int=2)


class Gate:
    """Work that begins, and ends when it may."""

    def __init__(self):
        self.begun, self.go = threading.Event(), threading.Event()

    def __call__(self):
        self.begun.set()
        assert self.go.wait(60)
        return "done"


@pytest.fixture
def ask():
    """Asks for tests; all of them end with the test."""
    made, asked = InTurn(), []

    def one(user, project=PROJECT):
        gate = Gate()
        asked.append((gate, made.ask(user, project, gate, Stop())))
        return gate, asked[-1][1]

    yield one
    for gate, _ in asked:
        gate.go.set()
    assert [future.result(60) for _, future in asked] == ["done"] * len(asked)


def test_the_next_place_goes_to_who_has_the_fewest_and_each_knows_its_turn(team, settings_of, person, ask):
    settings_of(**WHOLE, max_tests=2, max_user_tests=2, max_user_waiting=2)
    ada, ben = person("ada").user, person("ben").user
    first = [ask(ada) for _ in range(4)]
    assert all(gate.begun.wait(60) for gate, _ in first[:2])
    with pytest.raises(BusyError, match="your tests with Python"):
        ask(ada)
    bens = ask(ben, OTHER)
    assert turn_of(ben, OTHER) == Turn(0, is_own=False)
    assert turn_of(ben, PROJECT) is None
    assert turn_of(ada, PROJECT) == Turn(2, is_own=True)
    assert checkers.ask("user 1", lambda: "checked").result(60) == "checked"
    first[0][0].go.set()
    assert bens[0].begun.wait(60)  # and none of ada, who waits longer
    assert not first[2][0].begun.is_set()
    assert turn_of(ben, OTHER) is None
    bens[0].go.set()
    assert first[2][0].begun.wait(60)
    assert first[0][1].result(60) == "done"


def test_on_this_machine_one_user_has_all_places_and_what_fails_frees_its_own(user, settings_of, ask):
    settings_of(max_tests=3)
    with pytest.raises(ValueError, match="invalid literal"):
        InTurn().ask(user, PROJECT, partial(int, "x"), Stop()).result(60)
    assert all(gate.begun.wait(60) for gate, _ in [ask(user) for _ in range(3)])
    ask(user)
    assert turn_of(user, PROJECT) == Turn(0, is_own=False)


def test_tests_whose_client_has_left_give_their_waiting_place_back(user, settings_of, ask):
    settings_of(max_tests=1)
    gate, running = ask(user)
    assert gate.begun.wait(60)
    made, left = InTurn(), Gate()
    waiting = made.ask(user, OTHER, left, Stop())
    assert turn_of(user, OTHER) is not None
    assert waiting.cancel()
    made.ask(user, PROJECT, Gate(), Stop()).cancel()
    wait_until(lambda: turn_of(user, OTHER) is None, "the place is given back")
    assert not left.begun.is_set()
    assert not running.cancel()  # its stop ends it


def test_the_page_learns_how_many_are_before_it(api, project, user, settings_of, ask):
    settings_of(max_tests=1)
    address = f"projects/{project['id']}/test-with-python"
    running = ask(user)
    assert running[0].begun.wait(60)
    assert api.get(address) == {"position": None, "waits_for_own": False}
    ask(user, UUID(project["id"]))
    assert api.get(address) == {"position": 1, "waits_for_own": False}


class Ending:
    """Work that ends when it is stopped, as tests do whose process was ended."""

    def __init__(self):
        self.begun, self.stop = threading.Event(), Stop()

    def __call__(self):
        over = threading.Event()
        self.stop.bind(over.set)
        self.begun.set()
        assert over.wait(60)
        raise CheckerUnavailableError("The process of the tests gave no answer.")


def test_a_user_ends_own_tests_of_a_project_that_run_or_wait(team, settings_of, person, ask):
    """Asked for in another worker, which sees them on the board only."""
    settings_of(max_tests=1, max_user_tests=1, max_user_waiting=2)
    ada, ben = person("ada"), person("ben")
    project = ada.post("projects", {"name": "Robot"}, expect=201)["id"]
    address = f"projects/{project}/test-with-python"
    assert ada.delete(address, expect=404)["code"] == "no_tests"
    here, runs = InTurn(), Ending()
    running = here.ask(ada.user, UUID(project), runs, runs.stop)
    assert runs.begun.wait(60)
    waiting, other = Gate(), Gate()
    withdrawn = here.ask(ada.user, UUID(project), waiting, Stop())
    kept = here.ask(ada.user, OTHER, other, Stop())
    _, bens = ask(ben.user, UUID(project))
    ben.delete(address, expect=404)  # it is not theirs
    assert not running.done()
    ada.delete(address, expect=204)
    for ended in (running, withdrawn):
        with pytest.raises(TestsEndedError, match="You have ended"):
            ended.result(60)
    assert not waiting.begun.is_set()
    assert ada.get(address) == {"position": None, "waits_for_own": False}
    ada.delete(address, expect=404)
    other.go.set()
    assert kept.result(60) == "done"
    assert not bens.done()


def test_more_than_a_process_keeps_is_refused_and_takes_no_place(user, settings_of, ask, monkeypatch):
    settings_of(max_tests=1)
    monkeypatch.setattr(turns, "MOST_WAITING", 1)
    running = ask(user)
    assert running[0].begun.wait(60)
    ask(user)
    with pytest.raises(BusyError):
        ask(user)
    assert turn_of(user, PROJECT) == Turn(0, is_own=False)
