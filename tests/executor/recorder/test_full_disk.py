"""Users' code fills the disk with the recording: what was recorded before is there, and the run continues."""

from __future__ import annotations

import pytest

from tests.executor.recorder.test_process import joined
from tests.executor.session_client import SessionClient, app_zip, manager_process, run_data

pytestmark = pytest.mark.simulation

FILLS = """
import tempfile
import py_trees
from tree_gardener.ports import Port, set_output

class Forward(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"lin_speed": Port(float, default=0.3)}
    OUTPUT_PORTS = {"count": Port(int, default="{count}")}
    count = 0

    def initialise(self):
        self.file = open(tempfile.gettempdir() + "/filler", "wb", buffering=0)

    def update(self):
        self.count += 1
        set_output(self, "count", self.count)
        if self.count > 40:
            try:
                for size in (1 << 20, 4096):
                    while self.file.write(bytes(size)) == size:
                        pass
            except OSError as error:
                if self.count % 20 == 0:
                    print("cannot write:", error.strerror)
        return py_trees.common.Status.RUNNING
"""
DISK = 'mount -t tmpfs -o size=48m,mode=1777 tmpfs "$TMPDIR" && exec "$@"'
"""Mounts a small disk where only the manager and its children see it; so no rights are needed."""
LOST_S = 1.0


async def test_users_code_that_fills_the_disk_ends_the_recording_and_not_the_run(tmp_path):
    prefix = ("unshare", "--user", "--map-root-user", "--mount", "sh", "-c", DISK, "sh")
    async with manager_process(prefix=prefix, env={"TMPDIR": str(tmp_path)}) as manager:
        client = await SessionClient(manager.ready["port"]).open()
        assert await client.ask("run", run_data(app=app_zip(Forward=FILLS))) == "ack"
        line = await client.event("log", lambda data: "recording stops" in data["text"])
        assert line["data"]["text"] == (
            "The recording stops here: No space left on device. The run continues."
        )
        segment = client.named("segment")[-1]
        at = len(client.events)
        await client.event("log", lambda data: "cannot write" in data["text"], after=at)
        await client.event("tick", after=len(client.events))
        assert client.state == "application_running"
        assert not client.named("fault")
        found = await joined(manager, segment["run"])
        ticks = [(t, fields["number"]) for topic, t, fields in found if topic == "/bt/tick"]
        assert ticks[-1][0] >= line["data"]["time"] - LOST_S
        assert [number for _, number in ticks] == list(range(ticks[0][1], ticks[-1][1] + 1))
        assert found[-1][1] >= segment["to_t"] - 1e-6
        await client.close()
    assert list(tmp_path.iterdir()) == []  # the disk was the manager's own
