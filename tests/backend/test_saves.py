"""Saves of Python files by eight clients at the same time: each answer is correct."""

from __future__ import annotations

from contextlib import ExitStack

import pytest

from tests.backend.programs import sign_in
from tests.backend.services import redis
from tests.backend.serving import serving
from tests.benchmarks.load import settings_of
from tests.benchmarks.saves import storm
from tests.budget import count

CLIENTS = 8
pytestmark = [pytest.mark.timeout(900)]


async def test_no_answer_to_a_save_is_false(tmp_path, database_url):
    with ExitStack() as stack:
        services = {
            "BT_STUDIO_DATABASE_URL": database_url,
            "BT_STUDIO_REDIS_URL": stack.enter_context(redis()),
        }
        settings, port = settings_of(services)
        stack.enter_context(serving(tmp_path, "--port", str(port), **settings))
        answers = await storm(port, sign_in(tmp_path, settings, CLIENTS), count("true_saves"))
    assert answers.false == []
    assert answers.saved + answers.conflicts == count("true_saves")
    assert answers.conflicts
