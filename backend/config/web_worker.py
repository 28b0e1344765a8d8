"""One web worker, `python -m backend.config.web_worker`: it serves on the socket of its parent."""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import socket
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, Final

from backend.config.environment import environment
from backend.config.server import GRACE_S, load, run, tidy
from backend.core.processes.siblings import Family, answering, siblings

if TYPE_CHECKING:
    from collections.abc import Sequence

STDIN: Final = 0
ORPHAN_S: Final = 10.0
"""Seconds for which a worker may continue after its parent has ended."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Serves until a signal to end arrives, or until the parent has ended."""
    parser = argparse.ArgumentParser(prog="python -m backend.config.web_worker", description=__doc__)
    parser.add_argument("--fd", type=int, required=True, help="the socket that listens")
    parser.add_argument("--folder", type=Path, required=True, help="what all workers of the parent share")
    parser.add_argument("--count", type=int, required=True, help="how many workers there are")
    parser.add_argument("--own", type=int, required=True, help="which one this is")
    options = parser.parse_args(arguments)
    siblings.join(Family(options.folder, options.count, options.own))
    threading.Thread(target=_end_with_parent, args=(options.folder,), daemon=True).start()
    with Inherited(fileno=options.fd) as listener:
        run(listener, on_ready=_ready, log_level=environment().log_level, accepts_at_once=1)


class Inherited(socket.socket):
    """A listening socket whose backlog the parent has set."""

    def listen(self, *_: object) -> None:
        """Does nothing; otherwise the event loop would reduce the backlog."""


def _ready() -> None:
    load()  # the other workers answer meanwhile
    answering()
    threading.Thread(target=tidy, daemon=True).start()


def _end_with_parent(folder: Path) -> None:
    """Ends this worker when its parent ends.

    A pipe to the parent, which stays empty, closes even if the parent was killed.
    """
    while os.read(STDIN, 1):
        pass
    shutil.rmtree(folder, ignore_errors=True)  # a killed parent could not do it
    os.kill(os.getpid(), signal.SIGTERM)
    time.sleep(GRACE_S + ORPHAN_S)
    os._exit(1)


if __name__ == "__main__":
    main()
