"""`python -m backend.sessions.relay`: serves until a signal to end; robots continue without it."""

from __future__ import annotations

import argparse
import asyncio
import logging
import os
import signal
import socket
import ssl
import sys
from contextlib import suppress
from pathlib import Path
from typing import Final

from backend.confine import confine
from backend.sessions.relay.server import Relay
from backend.sessions.relay.tls import Bundle, BundleError, client_context, server_context

log = logging.getLogger("relay")

KEEPER_FOLDER: Final = "/run/bt-studio-keeper"
BUNDLE: Final = "/run/bt-studio-relay/host.pem"
PORT: Final = 7164
CHECK_S: Final = 4.0


def main() -> int:
    """Runs the command line; returns the exit status."""
    parser = argparse.ArgumentParser(prog="python -m backend.sessions.relay", description=__doc__)
    parser.add_argument("--check", action="store_true", help="only tells whether the relay works")
    is_check = parser.parse_args().check
    bundle = Path(os.environ.get("BT_STUDIO_RELAY_BUNDLE") or BUNDLE)
    host = os.environ.get("BT_STUDIO_RELAY_HOST") or "0.0.0.0"  # noqa: S104 - it is reached from elsewhere
    port = int(os.environ.get("BT_STUDIO_RELAY_PORT") or PORT)
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(levelname)s %(name)s: %(message)s")
    try:
        if is_check:
            _check(bundle, port)
        else:
            asyncio.run(_serve(bundle, host, port))
    except (BundleError, OSError) as error:
        sys.stderr.write(f"relay: {error}\n")
        return 1
    return 0


async def _serve(path: Path, host: str, port: int) -> None:
    bundle = Bundle(path, server_context)
    bundle.context()  # one that cannot be used is reported now
    folder = Path(os.environ.get("BT_STUDIO_KEEPER_FOLDER") or KEEPER_FOLDER)
    listener = socket.create_server((host, port), backlog=128)
    try:
        confine("relay")
    except OSError as error:
        log.warning("the relay may make all the system calls that its container may: %s", error)
    log.info("streams come to port %d", listener.getsockname()[1])
    serving = asyncio.create_task(Relay(bundle, folder).serve(listener))
    for number in (signal.SIGTERM, signal.SIGINT):
        asyncio.get_running_loop().add_signal_handler(number, serving.cancel)
    with listener, suppress(asyncio.CancelledError):
        await serving


def _check(path: Path, port: int) -> None:
    """Shakes hands with the relay of this host, whose certificate must be valid; it then lets nobody in.

    Raises:
        OSError: nobody listens, or the certificate is not valid any more.
    """
    context = client_context(path)
    context.check_hostname = False
    with (
        socket.create_connection(("127.0.0.1", port), CHECK_S) as plain,
        context.wrap_socket(plain) as secure,
    ):
        if secure.version() is None:
            raise ssl.SSLError("no handshake")


if __name__ == "__main__":
    sys.exit(main())
