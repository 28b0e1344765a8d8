"""Several clients on the same files: no acknowledged save is lost."""

from __future__ import annotations

import threading
from typing import Any

import hypothesis.strategies as st
import pytest
from django.db import connection
from hypothesis import HealthCheck, settings
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule, run_state_machine_as_test

from backend.accounts.writes import local_user
from backend.projects.errors import NameTakenError, RevisionConflictError
from backend.projects.storage import queries, writes
from backend.projects.storage.access import Need
from backend.projects.storage.changes import Content, FileChange
from backend.projects.storage.manifest import MANIFEST
from tests.budget import count

PATHS = ("actions/Go.py", "trees/MainTree.json")
clients = st.sampled_from(["ann", "bob"])
paths = st.sampled_from(PATHS)


class TwoClients(RuleBasedStateMachine):
    """Each client adds its own line to its version of a file; the file must keep every line."""

    @initialize()
    def begin(self):
        self.user = local_user()
        files = dict.fromkeys(PATHS, b"")
        project = writes.create_project(files, acting_user=self.user, name=f"P{id(self)}-{next(NUMBERS)}")
        self.project = project.id
        self.lines: dict[Any, Any] = {path: [] for path in PATHS}
        self.known = {}
        for client in ("ann", "bob"):
            self.load(client)

    @rule(client=clients)
    def load(self, client):
        project = queries.project(self.project, user=self.user, need=Need.READ)
        self.known[client] = {
            path: (file.revision, file.data) for path, file in queries.current_files(project, PATHS).items()
        }

    @rule(client=clients, path=paths)
    def save(self, client, path):
        self.write(client, [path])

    @rule(client=clients)
    def save_both(self, client):
        self.write(client, list(PATHS))

    @rule(client=clients, path=paths)
    def save_twice_because_the_answer_got_lost(self, client, path):
        before = dict(self.known[client])
        if line := self.write(client, [path]):
            self.known[client] = before
            self.write(client, [path], line=line)

    @rule(client=clients, data=st.data())
    def restore(self, client, data):
        project = queries.project(self.project, user=self.user, need=Need.READ)
        number = data.draw(st.integers(1, project.revision))
        then = queries.files_at(project, number, PATHS)
        writes.restore_revision(self.project, number, acting_user=self.user, paths=PATHS)
        self.lines = {path: then[path].data.decode().splitlines() for path in PATHS}

    def write(self, client, chosen, line=None):
        line = line or f"{client}{next(NUMBERS)}"
        wanted: dict[str, Any] = {}
        for path in chosen:
            revision, data = self.known[client].get(path, (0, b""))
            wanted[path] = FileChange(path, revision, Content.of(data + f"{line}\n".encode()))
        try:
            project = writes.save_files(self.project, list(wanted.values()), acting_user=self.user)
        except RevisionConflictError as error:
            conflicts = {row["path"] for row in error.extra["conflicts"]}
            self.load(client)
            return self.refused(conflicts, chosen)
        for path, change in wanted.items():
            if line not in self.lines[path]:
                self.lines[path].append(line)
            self.known[client][path] = (project.revision, change.content.data)
        return line

    def refused(self, conflicts, chosen):
        assert conflicts <= set(chosen)

    @invariant()
    def every_acknowledged_line_is_there(self):
        project = queries.project(self.project, user=self.user, need=Need.READ)
        found = queries.current_files(project)
        assert {path: found[path].data.decode().splitlines() for path in PATHS} == self.lines

    @invariant()
    def the_current_files_are_those_of_the_newest_revision(self):
        project = queries.project(self.project, user=self.user, need=Need.READ)
        assert queries.current_files(project) == dict(queries.files_at(project, project.revision))
        assert project.size == sum(len(data) for data in queries.contents(project).values())


NUMBERS = iter(range(1_000_000_000))


def test_no_interleaving_of_two_clients_loses_an_update(db):
    run_state_machine_as_test(
        TwoClients,
        settings=settings(
            max_examples=count("backend_revision_machine"),
            stateful_step_count=12,
            suppress_health_check=list(HealthCheck),
            derandomize=True,
            database=None,
        ),
    )


@pytest.mark.django_db(transaction=True)
def test_threads_that_save_at_once_all_get_through(user):
    project = writes.create_project({"log.txt": b""}, acting_user=user, name="Threads")
    conflicts = []

    def save(name):
        try:
            for number in range(6):
                while True:
                    file = queries.current_files(project, ["log.txt"])["log.txt"]
                    content = Content.of(file.data + f"{name}{number}\n".encode())
                    try:
                        change = FileChange("log.txt", file.revision, content)
                        writes.save_files(project.id, [change], acting_user=user)
                        break
                    except RevisionConflictError:
                        conflicts.append(name)
        finally:
            connection.close()

    threads = [threading.Thread(target=save, args=(name,)) for name in "abcd"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    lines = queries.current_files(project, ["log.txt"])["log.txt"].data.decode().split()
    assert sorted(lines) == sorted(f"{name}{number}" for name in "abcd" for number in range(6))
    project.refresh_from_db()
    assert project.revision == 25


@pytest.mark.django_db(transaction=True)
def test_one_name_goes_to_one_of_two_that_ask_at_once(user):
    outcomes = []

    def create():
        try:
            writes.create_project({MANIFEST: b"{}"}, acting_user=user, name="Same")
            outcomes.append("made")
        except NameTakenError:
            outcomes.append("taken")
        finally:
            connection.close()

    threads = [threading.Thread(target=create) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(outcomes) == ["made", "taken", "taken", "taken"]
