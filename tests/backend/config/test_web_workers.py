"""Several workers of one server, as real processes on a real PostgreSQL and Redis."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
from contextlib import contextmanager
from pathlib import Path

import psutil
import psycopg
import pytest
import requests
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from backend.config import web_worker
from backend.core.processes.metrics import requests as counted
from backend.core.processes.numbers import BEAT, read_page
from backend.core.processes.siblings import Family
from tests.backend.programs import run_program
from tests.backend.services import redis
from tests.backend.serving import REPOSITORY, TIMEOUT_S, serving, start
from tests.backend.sessions.keeper.conftest import Host
from tests.backend.test_postgresql import PASSWORD, signed_in
from tests.processes import command_line, with_word

FIRST_COUNT = counted._places["1xx"]
pytestmark = [pytest.mark.kills, pytest.mark.timeout(300)]


def until(holds, *, within_s=TIMEOUT_S):
    """Waits for a condition, and returns its value."""
    deadline = time.monotonic() + within_s
    while not (found := holds()):
        assert time.monotonic() < deadline, "it never came"
        time.sleep(0.05)
    return found


def folder_of(worker):
    """Returns the folder that a worker shares with its siblings."""
    line = worker.cmdline()
    return Path(line[line.index("--folder") + 1])


def made_to_wait(docker):
    """Makes the executors of a fake engine wait until this event is set before they come to the gate."""
    may_run, run = threading.Event(), docker.run

    def run_when_it_may(name, container):
        assert may_run.wait(TIMEOUT_S)
        run(name, container)

    docker.run = run_when_it_may
    may_run.set()
    return may_run


class Several:
    """A server with several workers, its database, and a browser."""

    environment: dict[str, str]
    may_run: threading.Event

    def __init__(self, served, database_url, host):
        self.served, self.host = served, host
        self.database = psycopg.connect(database_url, autocommit=True)
        self.browser = signed_in(served)
        self.base = served.base

    @property
    def workers(self):
        """The processes of the workers that run, by their numbers."""
        children = psutil.Process(self.served.process.pid).children()
        lines = {}
        for child in with_word("backend.config.web_worker", children):
            if line := command_line(child):  # it has not ended meanwhile
                lines[int(line[line.index("--own") + 1])] = child
        return lines

    @contextmanager
    def only(self, number):
        """Stops the other workers, so that new connections come to this worker."""
        others = [process for own, process in self.workers.items() if own != number]
        for process in others:
            process.suspend()
        try:
            yield
        finally:
            for process in others:
                process.resume()

    def at(self, number):
        """Returns a browser with a permanent connection to this worker."""
        browser = requests.Session()
        browser.headers.update(self.browser.headers)
        browser.cookies.update(self.browser.cookies)
        with self.only(number):
            assert browser.get(f"{self.base}/api/v1/me", timeout=30).status_code == 200
        return browser

    def socket_at(self, number, path):
        """A websocket to this worker."""
        cookies = "; ".join(f"{cookie.name}={cookie.value}" for cookie in self.browser.cookies)
        headers = {"Cookie": cookies, "Origin": self.base}
        with self.only(number):
            address = "ws" + self.base.removeprefix("http") + path
            return connect(address, additional_headers=headers, proxy=None, open_timeout=60)

    def project(self, name, **more):
        """A new project."""
        made = self.browser.post(f"{self.base}/api/v1/projects", json={"name": name} | more, timeout=60)
        assert made.status_code == 201, made.text
        return made.json()["id"]

    def session(self, browser, project):
        """Starts a session through a worker."""
        answer = browser.post(f"{self.base}/api/v1/projects/{project}/session", timeout=60)
        assert answer.status_code == 200, answer.text
        return answer.json()

    def counted(self, browser, name):
        """Returns a number of `/metrics` from this worker."""
        text = browser.get(f"{self.base}/metrics", timeout=60).text
        return float(next(row.split()[1] for row in text.splitlines() if row.startswith(name)))

    def holder(self):
        """Returns the process that maintains the sessions."""
        row = self.database.execute(
            "SELECT owner FROM executor_sessions_lease WHERE name = 'care'"
        ).fetchone()
        return int(row[0].split()[-2]) if row else None

    def living_holder(self):
        """Returns the same process if it is a running worker; the lease of a killed one lasts for a while."""
        holder = self.holder()
        return holder if holder in {process.pid for process in self.workers.values()} else None


def create(name, *more, **settings):
    """Makes an account in the terminal."""
    arguments = ("admin", "create", name, "--password-stdin", *more)
    run_program("backend.cli.main", *arguments, said=f"{PASSWORD}\n", **settings)


@pytest.fixture(scope="module")
def several(warm_postgresql):
    """A server with two workers that the tests of this file share."""
    with (
        tempfile.TemporaryDirectory() as name,
        warm_postgresql.database_url() as database_url,
        redis() as redis_url,
    ):
        folder = Path(name)
        host = Host(folder, "good", 10, patience_s=60)
        team = {
            "BT_STUDIO_MODE": "team",
            "BT_STUDIO_PUBLIC_URL": "http://127.0.0.1:8000",
            "BT_STUDIO_DATABASE_URL": database_url,
            "BT_STUDIO_REDIS_URL": redis_url,
            "BT_STUDIO_SECRET_KEY": "k" * 40,
            "BT_STUDIO_LAUNCHER": "docker",
            "BT_STUDIO_KEEPER_FOLDER": str(host.folder),
        }
        create("ada", **team, BT_STUDIO_DATA_DIR=name)
        with serving(folder, "--workers", "2", **team) as served:
            found = Several(served, database_url, host)
            found.environment, found.may_run = team, made_to_wait(host.docker)
            yield found
            found.database.close()
            children = psutil.Process(served.process.pid).children(recursive=True)
            assert served.end() == -signal.SIGTERM
            assert psutil.wait_procs(children, timeout=60)[1] == []
        host.close()


def test_a_worker_answers_when_its_modules_are_loaded(monkeypatch):
    order, has_tidied = [], threading.Event()
    monkeypatch.setattr(web_worker, "load", lambda: order.append("load"))
    monkeypatch.setattr(web_worker, "answering", lambda: order.append("answering"))
    monkeypatch.setattr(web_worker, "tidy", has_tidied.set)
    web_worker._ready()
    assert order == ["load", "answering"]
    assert has_tidied.wait(TIMEOUT_S)


def test_a_killed_worker_alone_is_replaced_and_its_counts_stay(several):
    before = several.workers
    asking = several.at(0)
    path = 'bt_studio_requests_total{status="2xx"}'
    counted = several.counted(asking, path)
    dying = several.at(1)
    for _ in range(3):
        dying.get(f"{several.base}/api/v1/me", timeout=60)
    # Each worker reports the sum over all workers: one request of `at`, and three others.
    assert several.counted(asking, path) == counted + 4
    assert several.counted(dying, path) == counted + 4
    before[1].kill()
    assert asking.get(f"{several.base}/api/v1/me", timeout=60).status_code == 200
    assert several.counted(asking, path) == counted + 5
    until(lambda: several.workers.get(1) not in {None, before[1]})
    assert several.workers[0] == before[0]
    again = several.at(1)
    assert several.counted(again, path) == several.counted(asking, path) == counted + 6


def test_a_burst_of_connections_is_shared_and_the_idle_say_that_they_are_awake(several):
    pages = Family(folder_of(several.workers[0]), 2, 0).pages()
    counts, beats = [read_page(page) for page in pages], [read_page(page)[BEAT] for page in pages]
    before = [sum(page[FIRST_COUNT : FIRST_COUNT + 5]) for page in counts]
    sockets = [socket.create_connection(("127.0.0.1", several.served.port)) for _ in range(60)]
    for each in sockets:
        each.sendall(b"GET /accounts/login/ HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n")
    for each in sockets:
        with each:
            assert each.recv(20).startswith(b"HTTP/1.1 200")
    until(
        lambda: all(
            sum(page[FIRST_COUNT : FIRST_COUNT + 5]) > n for page, n in zip(counts, before, strict=True)
        )
    )
    until(lambda: all(page[BEAT] > beat for page, beat in zip(counts, beats, strict=True)))


def test_a_save_through_one_worker_is_announced_through_the_other(several):
    project = several.project("Told")
    saving = several.at(0)
    with several.socket_at(1, f"/ws/projects/{project}/notices") as notices:
        assert json.loads(notices.recv(timeout=60))["revision"] == 1
        change = {"files": [{"path": "a.txt", "base_revision": 0, "content": "new"}]}
        saved = saving.post(f"{several.base}/api/v1/projects/{project}/changes", json=change, timeout=60)
        assert saved.status_code == 200
        told = json.loads(notices.recv(timeout=60))
        assert (told["revision"], told["author"]) == (2, "ada")


def test_the_end_of_a_session_waits_for_the_launch_of_another_worker(several):
    project = several.project("Ended early")
    starting, ending = several.at(0), several.at(1)
    engine = several.host.docker
    several.may_run.clear()
    session = several.session(starting, project)
    until(lambda: engine.containers)
    answers = []
    address = f"{several.base}/api/v1/sessions/{session['id']}"
    thread = threading.Thread(target=lambda: answers.append(ending.delete(address, timeout=120)))
    thread.start()
    until(lambda: starting.get(address, timeout=60).json()["state"] == "ended")
    waiting = "SELECT 1 FROM pg_locks WHERE locktype = 'advisory' AND NOT granted"
    until(lambda: several.database.execute(waiting).fetchone())
    assert not answers
    several.may_run.set()
    thread.join(TIMEOUT_S)
    assert [answer.status_code for answer in answers] == [204]
    assert engine.containers == {}


def test_a_closed_account_is_refused_by_every_worker_at_once(several):
    create("bob", "--user", **several.environment, BT_STUDIO_DATA_DIR=str(several.host.folder.parent))
    admin, several.browser = several.browser, signed_in(several.served, "bob")
    try:
        project = several.project("Bob's")
        browsers = [several.at(0), several.at(1)]
        with several.socket_at(1, f"/ws/projects/{project}/notices") as notices:
            several.database.execute("UPDATE accounts_user SET is_active = false WHERE username = 'bob'")
            for browser in browsers:
                assert browser.get(f"{several.base}/api/v1/me", timeout=60).status_code == 401
            several.database.execute("UPDATE accounts_user SET is_active = true WHERE username = 'bob'")
            assert browsers[1].get(f"{several.base}/api/v1/me", timeout=60).status_code == 200
            # Signing out through one worker closes the sockets at the other one.
            page = browsers[0].get(f"{several.base}/accounts/logout/", timeout=60)
            token = page.text.partition('name="csrfmiddlewaretoken" value="')[2].partition('"')[0]
            fields = {"csrfmiddlewaretoken": token}
            browsers[0].post(f"{several.base}/accounts/logout/", data=fields, timeout=60)
            with pytest.raises(ConnectionClosed) as closed:
                until(lambda: notices.recv(timeout=60) is None)
            assert closed.value.rcvd.code == 4401
            assert browsers[1].get(f"{several.base}/api/v1/me", timeout=60).status_code == 401
    finally:
        several.browser = admin


def test_one_worker_looks_after_all_and_the_other_when_it_was_killed(several):
    holder = until(several.living_holder)
    # Only one of the two collected the garbage; the other one asks again a day later.
    rows = several.database.execute("SELECT owner FROM executor_sessions_lease WHERE name = 'garbage'")
    assert len(rows.fetchall()) == 1
    session = several.session(several.at(0), several.project("Looked after"))
    address = f"{several.base}/api/v1/sessions/{session['id']}"
    browser = several.at(next(own for own, process in several.workers.items() if process.pid != holder))
    until(lambda: browser.get(address, timeout=60).json()["state"] == "ready")
    os.kill(holder, signal.SIGKILL)
    until(lambda: several.living_holder() not in {None, holder})
    # No page requests the session; the holder of the lease notes its end.
    several.host.docker.end(next(iter(several.host.docker.containers)), 3)
    state = "SELECT state FROM executor_sessions_session WHERE id = %s"
    until(lambda: several.database.execute(state, [session["id"]]).fetchone() == ("failed",))


def test_a_lease_has_one_holder_until_it_runs_out_or_is_given_back(several):
    script = """
        import django
        django.setup()
        from backend.sessions.lease import Holder
        one, two = Holder(), Holder()
        assert one.hold("x", 60) and not two.hold("x", 60) and one.hold("x", 0)
        assert two.hold("x", 60) and not one.hold("x", 60)
        two.give_back("x")
        assert one.hold("x", 60)
        try:
            with one.chore("y", 60) as is_ours, two.chore("y", 60) as is_theirs:
                assert is_ours and not is_theirs
                raise OSError("the disk is full")
        except OSError:
            pass
        with two.chore("y", 60) as is_theirs:
            assert is_theirs
        with one.chore("y", 60) as is_ours:
            assert not is_ours
    """
    run = [sys.executable, "-c", textwrap.dedent(script)]
    settings = {"DJANGO_SETTINGS_MODULE": "backend.config.settings"} | several.environment
    subprocess.run(run, cwd=REPOSITORY, env=os.environ | settings, check=True)


def test_all_workers_ask_one_pool_of_processes(several):
    project = several.project("Translated", template="laser_bump_and_go")
    parent = psutil.Process(several.served.process.pid)

    def translate(number):
        address = f"{several.base}/api/v1/projects/{project}/xml"
        return several.at(number).get(address, timeout=60).status_code

    def pool():
        [found] = with_word("backend.workers.service", parent.children())
        return found

    assert [translate(0), translate(1)] == [200, 200]
    at_work = with_word("backend.workers.worker", parent.children(recursive=True))
    assert {process.ppid() for process in at_work} == {pool().pid}
    before = pool()
    before.kill()
    until(lambda: [translate(0), translate(1)] == [200, 200])
    assert pool() != before


def test_workers_end_with_a_parent_that_was_killed(several, tmp_path):
    with serving(tmp_path, "--workers", "3", **several.environment) as served:
        children = psutil.Process(served.process.pid).children()
        assert len(children) == 4
        pages = folder_of(children[-1])
        assert pages.is_dir()
        assert served.end(signal.SIGKILL) == -signal.SIGKILL
        assert psutil.wait_procs(children, timeout=60)[1] == []
        assert not pages.exists()


def test_more_workers_than_the_database_admits_are_refused(several, tmp_path):
    refused = start(tmp_path, "--port", "0", "--workers", "60", **several.environment)
    _, said = refused.communicate(timeout=60)
    assert refused.returncode == 1
    assert "max_connections" in said
    assert "Traceback" not in said
