"""The state of a process as the kernel reports it."""

from __future__ import annotations

import asyncio
import os
import subprocess
import sys

from executor.supervision.signs import Notes, look_at


def test_a_process_that_computes_has_run_for_longer() -> None:
    before = look_at(os.getpid())
    sum(range(3_000_000))
    after = look_at(os.getpid())
    assert before is not None
    assert after is not None
    assert after.ran_s > before.ran_s


def test_a_process_that_is_gone_has_no_signs() -> None:
    with subprocess.Popen([sys.executable, "-c", ""]) as process:
        process.wait(60)
    assert look_at(process.pid) is None


async def test_a_process_that_is_gone_leaves_no_trace() -> None:
    notes = Notes()
    os.pwrite(notes.fd, (7).to_bytes(4, "little"), 0)
    assert notes.current_uid() == 7
    process = await asyncio.create_subprocess_exec(sys.executable, "-c", "")
    await process.wait()
    assert await notes.trace(process.pid) == ""
    notes.close()
    notes.close()
