"""Invitations."""

from __future__ import annotations

import pytest

from backend.accounts import groups, invitations, links
from backend.accounts.permissions import TeacherRequiredError
from backend.core.problems import NotFoundError


def test_an_invitation_brings_people_into_a_group_until_it_is_used_up(person):
    tina = person("tina", is_teacher=True).user
    group = groups.create("Robots", acting_user=tina)
    made = invitations.invite(acting_user=tina, group=group, days=1, max_uses=1)
    token = links.token_of("join", made.id)
    assert invitations.of_token(token) == made
    for _ in range(2):  # a user who already is a member does not use up the invitation
        invitations.accept(token, acting_user=person("ben").user if _ == 0 else tina, new_account=False)
    assert invitations.of_token(token) is None


def test_it_is_taken_back_by_who_made_it(person):
    tina, otto = (person(name, is_teacher=True).user for name in ("tina", "otto"))
    made = invitations.invite(acting_user=tina, group=None, days=1, max_uses=9)
    with pytest.raises(NotFoundError):
        invitations.revoke(made.id, acting_user=otto)
    invitations.revoke(made.id, acting_user=tina)
    assert invitations.usable(made.id) is None
    with pytest.raises(TeacherRequiredError):
        invitations.invite(acting_user=person("ben").user, group=None, days=1, max_uses=1)
