"""Saves and collects objects until it is killed: `python -m tests.backend.projects.storage.object_storm`.

Each line of the standard input is a seed and a mode; a process is forked for it. Lines of the output: `pid`,
what the process did, and `end` when it has ended. Imports are done once, so that it may be killed often.
"""

from __future__ import annotations

import hashlib
import os
import random
import sys
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from datetime import timedelta

WRITERS = 2
POOL = 5
"""So few contents are saved again and again that savers meet what the collection is about to delete."""


def say(*words):
    os.write(1, (" ".join(map(str, words)) + "\n").encode())


def write(seed):
    """Makes projects with large contents, and deletes some of them for good."""
    from backend.accounts.writes import local_user
    from backend.projects.storage import writes

    chance, user = random.Random(seed), local_user()  # noqa: S311
    for number in range(100_000):
        shared = random.Random(chance.randrange(POOL)).randbytes(3000)  # noqa: S311
        files = {"shared.bin": shared, "own.bin": chance.randbytes(3000)}
        project = writes.create_project(files, acting_user=user, name=f"{seed} {number} {time.time_ns()}")
        say("saved", project.id)
        if chance.random() < 0.7:
            say("gone", project.id)
            writes.delete_project(project.id, acting_user=user)


def collect():
    """Collects as if the days flew by; objects without rows are left to `sweep`, when nobody uploads."""
    from django.utils import timezone

    from backend.core.objects.store import the_store
    from backend.projects.storage import collection, writes

    while True:
        now = timezone.now()
        writes.collect_garbage(now=now + timedelta(days=400))
        collection.note(now)
        collection.mark(now + timedelta(days=1))
        say("collected", collection.delete(the_store()))


def sweep():
    """Sweeps as if a day had passed; then says what is left without a row."""
    from django.utils import timezone

    from backend.core.objects.store import the_store
    from backend.core.objects.sweep import sweep as delete_unnamed
    from backend.projects.models import Blob
    from backend.projects.storage import blobs, collection

    say("sweeping")
    now = timezone.now() + timedelta(hours=25)
    delete_unnamed(the_store(), blobs.FOLDER, collection.named, now=now)
    named = set(Blob.objects.exclude(stored_at=None).values_list("stored_at", flat=True))
    say("orphans", len({one.key for one in the_store().listed("")} - named))


def check():
    """Reads every content, and says which projects there are."""
    from backend.core.objects.store import the_store
    from backend.projects.models import Blob, Project

    for row in Blob.objects.exclude(stored_at=None).iterator():
        data = b"".join(the_store().read(row.stored_at))
        assert hashlib.sha256(data).hexdigest() == row.sha256
        say("blob", row.sha256)
    for project in Project.objects.filter(deleted_at=None).values_list("id", flat=True):
        say("project", project)
    sweep()


def storm(seed):
    with ThreadPoolExecutor() as pool:
        tasks = [pool.submit(write, f"{seed}.{number}") for number in range(WRITERS)]
        for done in as_completed([*tasks, pool.submit(collect)]):
            say("failed", repr(done.exception()))


def main():
    os.environ.setdefault("DJANGO_SETTINGS_MODULE", "backend.config.settings")
    from django.db import connections

    from backend.config.environment import environment
    from backend.config.server import make_data_folder, migrate

    make_data_folder(environment().data_dir)
    migrate()
    from backend.accounts.writes import local_user

    local_user()
    modes = {"storm": storm, "sweep": lambda _: sweep(), "check": lambda _: check()}
    for line in sys.stdin:
        seed, mode = line.split()
        connections.close_all()
        child = os.fork()
        if child == 0:
            try:
                say("pid", os.getpid())  # not by its parent, whom it could overtake
                modes[mode](seed)
            except BaseException as error:
                say("failed", repr(error))
            os._exit(0)
        os.waitpid(child, 0)
        say("end")


if __name__ == "__main__":
    main()
