"""Robots of several users on a full server: no user takes all places, and the queue is fair."""

from __future__ import annotations

import pytest

from backend.evaluations.work import somebody_waits_for_place
from backend.sessions import turns
from backend.sessions.choices import SessionState
from backend.sessions.lifecycle import writes
from backend.sessions.models import Session
from tests.backend.sessions.lifecycle.test_writes import launched

pytestmark = pytest.mark.django_db(transaction=True)


class Robots:
    """The robots of one user, by the names of their projects."""

    def __init__(self, person):
        self._person, self._started = person, {}

    def start(self, *names, **options):
        """Starts a robot of a new project for each name; returns the last answer."""
        for name in names:
            project = self._person.post("projects", {"name": name}, expect=201)["id"]
            answer = self._person.post(f"projects/{project}/session", **options)
            if "id" in answer:
                self._started[name] = answer["id"]
                launched(answer["id"])
        return answer

    def state(self, name):
        """Returns its state, the number of those before it, and whether it waits for its own user."""
        found = self._person.get(f"sessions/{self._started[name]}")
        if found["state"] != "queued":
            return found["state"]
        return found["position"] - 1, "own" if found["waits_for_own"] else "place"

    def end(self, name):
        """Ends a robot, and gives its place to the next."""
        self._person.delete(f"sessions/{self._started[name]}")
        before = set(Session.objects.filter(state=SessionState.QUEUED).values_list("id", flat=True))
        writes.start_queued()
        for session_id in before:
            launched(str(session_id))


@pytest.fixture
def robots(person, fake_manager):
    fake_manager("echo")
    yield lambda name, **rights: Robots(person(name, **rights))
    writes.end_all_sessions()


def test_one_user_has_two_robots_and_two_that_wait(robots):
    ada, ben = robots("ada"), robots("ben")
    ada.start("a1", "a2", "a3", "a4")
    assert [ada.state(name) for name in ("a1", "a2", "a3", "a4")] == [
        "ready",
        "ready",
        (0, "own"),
        (1, "own"),
    ]
    refused = ada.start("a5", expect=409)
    assert refused["code"] == "own_places_taken"
    assert "End one" in refused["hint"]
    # Those that wait for their own user take no place from others.
    assert not somebody_waits_for_place()
    ben.start("b1")
    assert ben.state("b1") == "ready"
    ada.end("a1")
    assert [ada.state(name) for name in ("a2", "a3", "a4")] == ["ready", "ready", (0, "own")]
    ada.start("a6")
    assert ada.state("a6") == (1, "own")


def test_the_next_place_goes_to_who_has_the_fewest(robots, settings_of):
    settings_of(max_sessions=3, max_user_sessions=3)
    ada, ben, eva = robots("ada"), robots("ben"), robots("eva")
    ada.start("a1", "a2")
    ben.start("b1")
    ada.start("a3")
    ben.start("b2")
    eva.start("e1")
    # The order is eva (0), ben (1), ada (2), though ada waits longest.
    assert [eva.state("e1"), ben.state("b2"), ada.state("a3")] == [(0, "place"), (1, "place"), (2, "place")]
    assert somebody_waits_for_place()
    ada.end("a1")
    # Now ada and ben have one each, and she has waited longer.
    assert [eva.state("e1"), ada.state("a3"), ben.state("b2")] == ["ready", (0, "place"), (1, "place")]
    # A newcomer with no robot does not start before their turn, but goes before those who have one.
    flo = robots("flo")
    flo.start("f1")
    assert [flo.state("f1"), ada.state("a3")] == [(0, "place"), (1, "place")]


def test_a_place_that_is_free_is_not_taken_by_who_comes_after_others(robots, settings_of):
    settings_of(max_sessions=1)
    ada, ben, eva = robots("ada"), robots("ben"), robots("eva")
    ada.start("a1")
    ben.start("b1")
    settings_of(max_sessions=2)
    eva.start("e1")  # the free place is ben's, though nobody has given it yet
    assert [ben.state("b1"), eva.state("e1")] == [(0, "place"), (1, "place")]
    assert writes.start_queued() == 1
    launched(ben._started["b1"])
    assert [ben.state("b1"), eva.state("e1")] == ["ready", (0, "place")]


def test_a_demonstration_has_no_limit_and_goes_first(robots, person, settings_of):
    settings_of(max_sessions=3)
    ada, ben = robots("ada"), robots("ben")
    teacher = person("tina")
    ada.start("a1", "a2", "a3")
    admin = person("root", is_admin=True)
    page = f"/admin/accounts/user/{teacher.user.pk}/change/"
    form = admin.client.get(page).context["adminform"].form.initial
    fields = {name: value for name, value in form.items() if isinstance(value, str) and name != "password"}
    admin.form(page, **fields, is_active="on", is_exempt="on")
    teacher.user.refresh_from_db()
    assert teacher.user.is_exempt
    tina = Robots(teacher)
    tina.start("t1")
    ben.start("b1")
    tina.start("t2", "t3", "t4")
    assert [tina.state(name) for name in ("t1", "t2", "t3", "t4")] == [
        "ready", (0, "place"), (1, "place"), (2, "place"),
    ]  # fmt: skip
    assert ben.state("b1") == (3, "place")
    ada.end("a1")
    assert [tina.state("t2"), tina.state("t3")] == ["ready", (0, "place")]


def test_users_see_their_own_robots_and_may_end_them(robots, person):
    ben = person("ben")
    ada = robots("ada")
    ada.start("a1", "a2", "a3")
    assert ben.get("sessions")["items"] == []
    listed = ada._person.get("sessions")["items"]
    assert [(row["project_name"], row["state"]) for row in listed] == [
        ("a1", "ready"), ("a2", "ready"), ("a3", "queued"),
    ]  # fmt: skip
    assert listed[2]["waits_for_own"]
    ada.end("a2")
    assert [row["project_name"] for row in ada._person.get("sessions")["items"]] == ["a1", "a3"]


def test_on_localhost_there_is_no_limit(api, user, fake_manager):
    fake_manager("echo")
    own = Robots(api)
    own.start("1", "2", "3", "4", "5")
    assert {own.state(name) for name in "12345"} == {"ready"}
    assert turns.turn_of(Session.objects.first()) is None
    writes.end_all_sessions()
