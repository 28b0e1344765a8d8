"""The start of a server for tests."""

from __future__ import annotations

import signal

from tests.backend.serving import serving

SAID = 200_000
PROGRAM = f"""
import signal, sys
from pathlib import Path
sys.stderr.write("x" * {SAID})
ready = Path(sys.argv[sys.argv.index("--ready-file") + 1])
ready.write_text('{{"port": 1, "url": "http://127.0.0.1:1/?token=t"}}')
signal.pause()
"""


def test_a_server_that_says_more_than_a_pipe_holds_does_not_wait(tmp_path):
    with serving(tmp_path, program=("-c", PROGRAM)) as served:
        assert served.end() == -signal.SIGTERM
    output, errors = served.output
    assert (output, len(errors)) == ("", SAID)
