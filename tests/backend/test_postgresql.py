"""The suite of SQLite on a real PostgreSQL with Redis, in its own process."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
import requests

from tests.backend.services import redis
from tests.backend.serving import REPOSITORY, TIMEOUT_S, serving
from tests.budget import count

PASSWORD = "Correct-horse-9"
# The parts that depend on the database: storage, locks, caches after a commit, shares, and numbers of
# queries.
PART = (
    "tests/backend/projects/storage",
    "tests/backend/projects/test_after_commit_writes.py",
    "tests/backend/accounts/test_sharing.py",
    "tests/backend/test_query_budgets.py",
    "tests/backend/runs/test_parallel.py",
    "tests/backend/evaluations/test_writes.py",
    "tests/backend/evaluations/test_queries.py",
    "tests/backend/core/test_process_locks.py",
    "tests/backend/sessions/launchers/kubernetes/test_connections.py",
    "tests/backend/sessions/warm",
)
# All of storage, permissions, concurrency and accounts. The kill storm starts its own servers, on SQLite.
WHOLE = (
    "tests/backend/projects",
    "tests/backend/accounts",
    "tests/backend/test_permissions.py",
    "tests/backend/test_query_budgets.py",
    "tests/backend/runs/test_parallel.py",
    "tests/backend/evaluations/test_writes.py",
    "tests/backend/evaluations/test_queries.py",
    "tests/backend/core/test_process_locks.py",
    "tests/backend/sessions/launchers/kubernetes/test_connections.py",
    "tests/backend/sessions/warm",
    "--ignore=tests/backend/projects/test_durability.py",
)


@pytest.mark.timeout(900)
def test_the_suite_passes_on_postgresql_and_redis(warm_postgresql):
    # Django prefixes the name of the tests' database; that database has its tables already.
    with warm_postgresql.database("test_") as name, redis() as redis_url:
        database_url = warm_postgresql.url_of(name.removeprefix("test_"))
        services = {"BT_STUDIO_DATABASE_URL": database_url, "BT_STUDIO_REDIS_URL": redis_url}
        command = [
            sys.executable,
            "-m",
            "pytest",
            "-q",
            "-p",
            "no:cacheprovider",
            "-p",
            "no:tests.leaks",  # this run looks for leaks of that one, too, when all its own processes end
            "--reuse-db",
            *(WHOLE if count("backend_on_postgresql") else PART),
        ]
        run = subprocess.run(
            command, cwd=REPOSITORY, env=os.environ | services, capture_output=True, text=True, check=False
        )
    assert run.returncode == 0, run.stdout[-8000:] + run.stderr[-2000:]


@pytest.mark.kills
@pytest.mark.timeout(300)
def test_a_server_continues_after_its_database_was_restarted(tmp_path, warm_postgresql, database_url):
    """Its event loop asks the database in a thread that keeps its connection, and so do sockets."""
    with serving(tmp_path, BT_STUDIO_DATABASE_URL=database_url) as server:
        ready = f"{server.base}/health/ready"
        assert requests.get(ready, timeout=TIMEOUT_S).status_code == 200
        with warm_postgresql.crashed():
            assert requests.get(ready, timeout=TIMEOUT_S).status_code == 503
        assert requests.get(ready, timeout=TIMEOUT_S).status_code == 200


@pytest.mark.kills
@pytest.mark.timeout(300)
def test_two_web_servers_share_one_database_and_a_killed_one_loses_nothing(tmp_path, warm_postgresql):
    # The web server is killed, not the database: what is committed is safe without a sync.
    with warm_postgresql.database_url(is_migrated=False) as database_url, redis() as redis_url:
        team = {
            "BT_STUDIO_MODE": "team",
            "BT_STUDIO_UNSAFE_USERS_RUN_AS_SERVER": "true",
            "BT_STUDIO_PUBLIC_URL": "http://127.0.0.1:8000",
            "BT_STUDIO_DATABASE_URL": database_url,
            "BT_STUDIO_REDIS_URL": redis_url,
            "BT_STUDIO_SECRET_KEY": "k" * 40,
        }
        folders = [tmp_path / name for name in ("first", "second")]
        for folder in folders:
            folder.mkdir()
        make = [sys.executable, "-m", "backend.cli.main", "admin", "create", "ada", "--password-stdin"]
        environment = os.environ | team | {"BT_STUDIO_DATA_DIR": str(tmp_path / "third")}
        # Both find an empty database and migrate it.
        making = subprocess.Popen(make, cwd=REPOSITORY, env=environment, stdin=subprocess.PIPE, text=True)
        with serving(folders[0], **team) as first, serving(folders[1], **team) as second:
            making.communicate(f"{PASSWORD}\n", timeout=TIMEOUT_S)
            assert making.returncode == 0
            browser = signed_in(first)
            made = browser.post(f"{first.base}/api/v1/projects", json={"name": "Kept"})
            assert made.status_code == 201
            project = made.json()["id"]
            change = {"files": [{"path": "a.txt", "base_revision": 0, "content": "kept"}]}
            saved = browser.post(f"{first.base}/api/v1/projects/{project}/changes", json=change)
            assert saved.status_code == 200
            first.process.kill()
            # A sign-in at one server is valid at the other, and an acknowledged save is visible there.
            browser.headers["Origin"] = second.base
            found = browser.get(f"{second.base}/api/v1/projects/{project}/files/a.txt")
            assert found.text == "kept"


def signed_in(server, name="ada"):
    """A session of `requests` that went through the sign-in page."""
    browser = requests.Session()
    browser.headers["Origin"] = server.base
    page = browser.get(f"{server.base}/accounts/login/")
    token = page.text.partition('name="csrfmiddlewaretoken" value="')[2].partition('"')[0]
    fields = {"login": name, "password": PASSWORD, "csrfmiddlewaretoken": token}
    answer = browser.post(f"{server.base}/accounts/login/", data=fields, allow_redirects=False)
    assert answer.status_code == 302, answer.text
    return browser
