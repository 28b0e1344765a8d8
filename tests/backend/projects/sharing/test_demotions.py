"""Every way in which a role ends or becomes lower is noticed."""

from __future__ import annotations

from typing import Any

from backend.accounts.rights import lessened
from backend.projects.sharing import demotions
from tests.backend.accounts.conftest import person, team  # noqa: F401 - fixtures
from tests.backend.accounts.test_sharing import project_of


def test_a_member_who_leaves_or_is_lowered_loses_rights(person, django_capture_on_commit_callbacks):  # noqa: F811
    heard: list[Any] = []

    def hear(sender: Any, *, project_id: Any, **_: Any) -> None:
        heard.append(str(project_id))

    lessened.connect(hear)
    olga = person("olga")
    person("fred")
    one = project_of(olga)
    with django_capture_on_commit_callbacks(execute=True):
        olga.post(f"projects/{one}/shares", {"name": "fred", "role": "editor"})
    assert heard == []
    with django_capture_on_commit_callbacks(execute=True):
        olga.post(f"projects/{one}/shares", {"name": "fred", "role": "viewer"})
        olga.delete(f"projects/{one}/shares/people/fred")
    assert set(heard) == {one}
    lessened.disconnect(hear)
    assert demotions.watch_roles.__doc__
