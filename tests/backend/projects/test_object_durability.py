"""Processes that save and collect objects are killed: nothing that is named is missing, and orphans go."""

from __future__ import annotations

import logging
import os
import random
import signal
import subprocess
import sys
from contextlib import ExitStack

import pytest

from tests.backend.migrated import add_sqlite
from tests.backend.serving import REPOSITORY
from tests.budget import count

log = logging.getLogger(__name__)


class Storms:
    """The process that forks those that are killed."""

    def __init__(self, process):
        self.process = process
        self.kept, self.gone = set(), set()

    def run(self, seed, mode, most=None):
        """Runs a mode; kills it after `most` lines. Returns its lines."""
        print(seed, mode, file=self.process.stdin, flush=True)
        word, pid = self.process.stdout.readline().split()
        assert word == "pid"
        lines = []
        while (line := self.process.stdout.readline().strip()) != "end":
            assert line, "the process of the test has ended"
            assert not line.startswith("failed"), line
            lines.append(line)
            if len(lines) == most:
                os.kill(int(pid), signal.SIGKILL)
        return lines

    def storm(self, seed, most):
        for line in self.run(seed, "storm", most):
            word, what = line.split()
            {"saved": self.kept, "gone": self.gone}.get(word, set()).add(what)

    def check(self):
        """Everything that is named is there; every project that was acknowledged and not deleted, too."""
        lines = [line.split() for line in self.run(0, "check")]
        found = {what for word, *rest in lines for what in rest if word == "project"}
        assert self.kept - self.gone <= found
        assert lines[-1] == ["orphans", "0"]
        return sum(line[0] == "blob" for line in lines)


@pytest.mark.kills
@pytest.mark.timeout(0)
@pytest.mark.parametrize("database", ["sqlite", "postgresql"])
def test_no_named_object_is_missing_and_no_orphan_stays(tmp_path, database, warm_bucket, request):
    kills, chance = count("backend_object_kills"), random.Random(5)  # noqa: S311
    with ExitStack() as stack:
        warm_bucket.fresh()
        settings = warm_bucket.variables | {
            "BT_STUDIO_DATA_DIR": str(tmp_path),
            "BT_STUDIO_OBJECT_STORE_FROM_BYTES": "1000",
        }
        add_sqlite(tmp_path)
        if database == "postgresql":
            # The web server is killed, not the database: what is committed is safe without a sync.
            settings["BT_STUDIO_DATABASE_URL"] = request.getfixturevalue("database_url")
        clean = {name: value for name, value in os.environ.items() if not name.startswith("BT_STUDIO_")}
        process = subprocess.Popen(
            [sys.executable, "-m", "tests.backend.projects.storage.object_storm"],
            cwd=REPOSITORY,
            env=clean | settings,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        stack.enter_context(process)
        storms = Storms(process)
        for kill in range(kills):
            storms.storm(kill, chance.randint(5, 60))
            storms.run(kill, "sweep", most=1)  # killed, too
            blobs = storms.check()
        process.stdin.close()
    log.info("%d kills, %d projects, %d blobs at the end", kills, len(storms.kept), blobs)
    assert storms.kept - storms.gone
