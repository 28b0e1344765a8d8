"""Whether the tree of a session is held, as its executor says."""

from __future__ import annotations

import pytest

from backend.sessions.manager.holds import is_held
from backend.sessions.models import Session
from tests.backend.sessions.lifecycle.test_writes import launched
from tests.backend.sessions.test_maintenance import start

pytestmark = pytest.mark.django_db(transaction=True)


__all__ = ["start"]


@pytest.mark.parametrize(("kind", "held"), [("held", True), ("echo", False)])
def test_the_executor_is_asked(start, fake_manager, kind, held):
    fake_manager(kind)
    launched(start("One")["id"])
    assert is_held(Session.objects.get()) is held


def test_an_executor_that_is_gone_holds_nothing():
    assert not is_held(Session(address="127.0.0.1:1"))
