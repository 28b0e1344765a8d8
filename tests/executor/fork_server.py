"""Forks processes of the product that have loaded their modules already: loading costs more than most runs.

`python -m tests.executor.fork_server N` answers the requests on the socket N until that is closed. A process
has the arguments, the environment and the files that it would have, but shares hash seed and addresses with
the others of its server.
"""

from __future__ import annotations

import fcntl
import gc
import importlib
import json
import os
import socket
import sys
import traceback
from typing import Any, Final, NoReturn

from executor.application import compat
from executor.supervision.confine import die_with_parent

LOADED: Final = (
    "backend.cli.main",
    "backend.cli.run",
    "backend.cli.shared.progress",
    "backend.cli.shared.translation",
    "executor.application.changes.program",
    "executor.application.debugging",
    "executor.application.profiling",
    "executor.application.recording",
    "executor.application.ros",
    "executor.exact.process",
    "executor.exact.world",
    "executor.headless.lockstep",
    "executor.recorder.process",
    "executor.world.process",
    "tree_gardener.runner",
)
LONGEST: Final = 1 << 20
FIRST_FREE: Final = 200
"""Descriptors below are for the process itself."""


def main() -> None:
    """Serves one client."""
    die_with_parent()
    link = socket.socket(fileno=int(sys.argv[1]))
    for name in LOADED:
        importlib.import_module(name)
    compat.warm_up()
    compat.install()
    gc.collect()
    gc.freeze()
    while True:
        data, fds, _, _ = socket.recv_fds(link, LONGEST, 16)
        if not data:
            return
        request = json.loads(data)
        if (pid := request.get("ended")) is not None:
            answer = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
        elif (answer := os.fork()) == 0:
            link.close()
            _become(request, fds)
        for fd in fds:
            os.close(fd)
        link.send(json.dumps(answer).encode())


def _become(request: dict[str, Any], fds: list[int]) -> NoReturn:
    """Runs the `main` of a module."""
    code = 1
    try:
        high = [fcntl.fcntl(fd, fcntl.F_DUPFD, FIRST_FREE) for fd in fds]
        for fd in fds:
            os.close(fd)
        for fd, number in zip(high, request["numbers"], strict=True):
            os.dup2(fd, number)
            os.close(fd)
        os.environ.clear()
        os.environ.update(request["environment"])
        os.chdir(request["folder"])
        sys.argv = [request["module"], *request["arguments"]]
        code = importlib.import_module(request["module"]).main() or 0
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else int(end.code is not None)
        if isinstance(end.code, str):
            sys.stderr.write(f"{end.code}\n")
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


if __name__ == "__main__":
    main()
