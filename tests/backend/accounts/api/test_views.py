"""The addresses of accounts and groups."""

from __future__ import annotations

from backend.accounts.api import views


def test_a_user_gets_to_know_whether_others_python_reaches_their_projects(person, settings_of):
    ada = person("ada")
    assert ada.get("me")["users_run_as_server"] is True
    settings_of(launcher="docker")
    assert ada.get("me")["users_run_as_server"] is False


def test_a_teacher_makes_a_group_and_invites(person):
    tina = person("tina", is_teacher=True)
    assert tina.get("me")["user"] == "tina"
    group = tina.post("groups", {"name": "Robots"}, expect=201)
    made = tina.post(f"groups/{group['id']}/invitations", {"days": 1, "max_uses": 2}, expect=201)
    assert tina.patch(f"groups/{group['id']}", {"name": "Robots II"})["name"] == "Robots II"
    assert person("ben").problem("POST", "groups", 403, {"name": "Mine"}) == "teacher_required"
    assert made
    assert views.Groups.__doc__
