"""Groups, such as classes."""

from __future__ import annotations

import pytest

from backend.accounts import groups
from backend.accounts.permissions import TeacherRequiredError
from backend.core.problems import NotFoundError


def test_a_teacher_makes_renames_and_deletes_a_group(person):
    tina = person("tina", is_teacher=True).user
    made = groups.create("Robots", acting_user=tina)
    assert groups.rename(made.id, "Robots II", acting_user=tina).name == "Robots II"
    assert list(groups.groups_of(tina)) == [made]
    groups.delete(made.id, acting_user=tina)
    assert list(groups.groups_of(tina)) == []


def test_a_student_makes_none_and_sees_none_of_others(person):
    made = groups.create("Robots", acting_user=person("tina", is_teacher=True).user)
    ben = person("ben").user
    with pytest.raises(TeacherRequiredError):
        groups.create("Mine", acting_user=ben)
    with pytest.raises(NotFoundError):
        groups.group(made.id, user=ben)
