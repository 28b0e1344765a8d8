"""The contract of launchers."""

from __future__ import annotations

import pytest

from backend.sessions.launchers.base import Launcher, Started


def test_a_launcher_that_lacks_a_method_fails_when_it_is_defined():
    with pytest.raises(TypeError, match="poll, stop"):

        class Half(Launcher):
            name = "half"

            def start(self, spec):
                return Started("", {})


def test_a_launcher_needs_a_name():
    with pytest.raises(TypeError, match="name"):

        class Nameless(Launcher):
            def start(self, spec):
                return Started("", {})

            def poll(self, state):
                return None

            def stop(self, state, *, timeout_s):
                return None
