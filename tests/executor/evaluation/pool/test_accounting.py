"""Processor time and memory of processes."""

import os
import subprocess
import sys

from executor.evaluation.pool.accounting import SCRATCH_PREFIX, usage, written_bytes
from executor.supervision.descendants import descendants

BUSY = """import subprocess, sys
child = subprocess.Popen([sys.executable, "-c", "import time; print(1, flush=True); time.sleep(60)"])
end = __import__("time").process_time() + 0.3
while __import__("time").process_time() < end: pass
print("done", flush=True)
sys.stdin.read()
child.kill(); child.wait()
"""


def test_a_family_is_found_and_counted():
    with subprocess.Popen(
        [sys.executable, "-c", BUSY], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        assert {process.stdout.readline(), process.stdout.readline()} == {"1\n", "done\n"}
        [child] = descendants(process.pid)
        assert process.pid in descendants(os.getpid())
        used = usage([process.pid, child])
        assert used.cpu_s >= 0.3
        assert used.rss_bytes > 5_000_000
        process.stdin.close()
        process.wait()
    assert usage([process.pid]) == (0, 0)
    assert descendants(process.pid) == []


def test_what_sealed_processes_have_written_is_counted_alone(tmp_path):
    scratch = tmp_path / f"{SCRATCH_PREFIX}1" / "app"
    scratch.mkdir(parents=True)
    (tmp_path / "of the run").write_bytes(bytes(1 << 20))
    assert written_bytes(str(tmp_path)) == 0
    for name in ("a", "b"):
        (scratch / name).write_bytes(bytes(1 << 20))
    assert 2 << 20 <= written_bytes(str(tmp_path)) < 3 << 20
    assert written_bytes(str(tmp_path / "nothing here")) == 0
