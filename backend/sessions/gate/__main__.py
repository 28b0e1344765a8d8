"""`python -m backend.sessions.gate`: serves until a signal to end; running sessions are not affected."""

from __future__ import annotations

import argparse
import logging
import os
import signal
import sys
from pathlib import Path
from typing import Final

from backend.confine import confine
from backend.sessions.gate.doors import Doors
from backend.sessions.gate.errors import GateError
from backend.sessions.gate.probe import probe
from backend.sessions.gate.server import GateServer

log = logging.getLogger("gate")

DOORS_FOLDER: Final = "/run/bt-studio"
CONTROL_SOCKET: Final = "/run/bt-studio-control/gate.sock"


def main() -> int:
    """Runs the command line; returns the exit status."""
    parser = argparse.ArgumentParser(prog="python -m backend.sessions.gate", description=__doc__)
    parser.add_argument("--check", action="store_true", help="only goes through the gate once")
    doors = Path(os.environ.get("BT_STUDIO_GATE_FOLDER") or DOORS_FOLDER)
    control = Path(os.environ.get("BT_STUDIO_GATE_CONTROL") or CONTROL_SOCKET)
    is_check = parser.parse_args().check
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(levelname)s %(name)s: %(message)s")
    try:
        if is_check:
            probe(control, doors)
        else:
            _serve(doors, control)
    except (GateError, OSError) as error:
        sys.stderr.write(f"gate: {error}\n")
        return 1
    return 0


def _serve(doors: Path, control: Path) -> None:
    server = GateServer(Doors(doors), control)
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: server.end())
    try:
        confine("gate")
    except OSError as error:
        log.warning("the gate may make all the system calls that its container may: %s", error)
    log.info("doors are in %s", doors)
    server.serve()


if __name__ == "__main__":
    sys.exit(main())
