"""`python -m backend.sessions.keeper`: serves until a signal to end; running executors are not affected."""

from __future__ import annotations

import argparse
import logging
import os
import signal
import sys
import threading
import time
from pathlib import Path
from typing import Final

from backend.confine import confine
from backend.sessions.keeper.docker import Docker
from backend.sessions.keeper.errors import KeeperError
from backend.sessions.keeper.gate import Gate
from backend.sessions.keeper.group import check_socket
from backend.sessions.keeper.plan import GATE_FOLDER, read_plan
from backend.sessions.keeper.server import KeeperServer
from backend.sessions.keeper.service import Keeper
from backend.sessions.keeper.tools import ToolsKeeper
from backend.sessions.keeper.unix_http import ask

log = logging.getLogger("keeper")

KEEPER_FOLDER: Final = "/run/bt-studio-keeper"
CONTROL_SOCKET: Final = "/run/bt-studio-control/gate.sock"
DOCKER_SOCKET: Final = "/var/run/docker.sock"
TIDY_EVERY_S: Final = 5
# Set where an earlier release had further machines; nothing starts as if they still were there.
REMOVED: Final = ("BT_STUDIO_HOST_SESSIONS", "BT_STUDIO_KEEPER_SILENCE_S")
INSTEAD: Final = (
    "this setting is gone: robots on several machines run on Kubernetes (docs/how-to/run-on-kubernetes.md, "
    "“Three machines with k3s”); on one machine BT_STUDIO_MAX_SESSIONS is the number of robots"
)


def main() -> int:
    """Runs the command line; returns the exit status."""
    parser = argparse.ArgumentParser(prog="python -m backend.sessions.keeper", description=__doc__)
    parser.add_argument("--check", action="store_true", help="only tells whether the keeper works")
    folder = Path(os.environ.get("BT_STUDIO_KEEPER_FOLDER") or KEEPER_FOLDER)
    if parser.parse_args().check:
        return 0 if ask(str(folder / "keeper.sock"), "GET", "/health", timeout_s=4)[0] == 200 else 1
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(levelname)s %(name)s: %(message)s")
    try:
        _serve(folder)
    except (ValueError, KeeperError, OSError) as error:
        sys.stderr.write(f"keeper: {error}\n")
        return 1
    return 0


def _serve(folder: Path) -> None:
    for name in REMOVED:
        if os.environ.get(name):
            raise ValueError(f"{name}: {INSTEAD}")
    docker_socket = os.environ.get("BT_STUDIO_DOCKER_SOCKET") or DOCKER_SOCKET
    check_socket(docker_socket)
    try:
        confine("keeper")
    except OSError as error:
        log.warning("the keeper may make all the system calls that its container may: %s", error)
    docker = Docker(docker_socket)
    gate_folder = Path(os.environ.get("BT_STUDIO_GATE_FOLDER") or GATE_FOLDER)
    gate_source, stack = _place(docker, gate_folder)
    plan = read_plan(gate_source=gate_source, stack=stack)
    max_sessions = int(os.environ.get("BT_STUDIO_MAX_SESSIONS") or 20)
    control = Path(os.environ.get("BT_STUDIO_GATE_CONTROL") or CONTROL_SOCKET)
    gate = Gate(control, folder / "sessions")
    keeper = Keeper(docker, gate, plan, max_sessions=max_sessions)
    max_tools = int(os.environ.get("BT_STUDIO_MAX_TOOLS") or 20)
    tools = ToolsKeeper(docker, gate, plan, max_tools=max_tools)
    server = KeeperServer(folder / "keeper.sock", keeper, tools)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    ended = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: ended.set())
    log.info("the keeper of %s starts %s, at most %d", stack, plan.image, max_sessions)
    while not ended.wait(TIDY_EVERY_S):
        try:
            keeper.end_crowded()
            keeper.tidy(time.time())
            tools.tidy(time.time())
        except KeeperError as error:
            log.warning("%s", error.detail)
    server.shutdown()


def _place(docker: Docker, gate_folder: Path) -> tuple[str, str]:
    """Returns the gate's volume (or folder), and the name of the stack.

    Docker's record of the keeper's own container has both.
    """
    stack = os.environ.get("BT_STUDIO_STACK", "")
    own = docker.inspect(os.environ.get("HOSTNAME", "") or "-")
    if own is None:
        return str(gate_folder), stack or "bt-studio"
    stack = stack or own["Config"]["Labels"].get("com.docker.compose.project", "bt-studio")
    for mount in own["Mounts"]:
        if mount["Destination"] == str(gate_folder):
            return str(mount.get("Name") or mount["Source"]), stack
    raise ValueError(f"{gate_folder} must be a volume, so that executors can be given it")


if __name__ == "__main__":
    sys.exit(main())
