"""What holds on SQLite holds on a real PostgreSQL with Redis: the same suite, in a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from tests.backend.services import postgresql, redis
from tests.backend.serving import REPOSITORY

# Storage, permissions, concurrency, accounts. The kill storm starts servers of its own, on SQLite.
SUITE = (
    "tests/backend/projects",
    "tests/backend/accounts",
    "tests/backend/test_permissions.py",
    "tests/backend/test_query_budgets.py",
    "--ignore=tests/backend/projects/test_durability.py",
)


@pytest.mark.timeout(900)
def test_the_suite_passes_on_postgresql_and_redis():
    with postgresql(fsync="off", synchronous_commit="off") as database_url, redis() as redis_url:
        services = {"BT_STUDIO_DATABASE_URL": database_url, "BT_STUDIO_REDIS_URL": redis_url}
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *SUITE]
        run = subprocess.run(
            command, cwd=REPOSITORY, env=os.environ | services, capture_output=True, text=True, check=False
        )
    assert run.returncode == 0, run.stdout[-8000:] + run.stderr[-2000:]
