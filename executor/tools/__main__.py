"""`python -m executor.tools`: fetches its socket from the gate, and serves until it has no clients."""

from __future__ import annotations

import argparse
import asyncio
import logging
import os
import signal
import sys
from pathlib import Path

from executor.manager.gate import fetch_listener
from executor.tools.server import ToolsServer

_log = logging.getLogger(__name__)


async def _serve(server: ToolsServer) -> None:
    loop = asyncio.get_running_loop()
    for number in (signal.SIGTERM, signal.SIGINT):
        loop.add_signal_handler(number, server.end)
    await server.run()


def main(arguments: list[str] | None = None) -> int:
    """Runs the command line; returns the exit status."""
    parser = argparse.ArgumentParser(prog="python -m executor.tools", description=__doc__)
    parser.add_argument("--gate", type=Path, required=True, help="unix socket that hands out our own")
    parser.add_argument("--session", required=True, help="our id, for the gate")
    parser.add_argument("--token-env", required=True, help="environment variable that holds the token")
    parser.add_argument("--grace", type=float, default=600.0, help="seconds that we stay without clients")
    options = parser.parse_args(arguments)
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(levelname)s %(name)s: %(message)s")
    logging.getLogger("websockets").setLevel(logging.WARNING)
    token = os.environ.pop(options.token_env, "")
    try:
        listener = fetch_listener(options.gate, options.session, token)
    except OSError as error:
        sys.stderr.write(f"tools: no socket from the gate {options.gate}: {error}\n")
        return 1
    asyncio.run(_serve(ToolsServer(listener, token, grace_s=options.grace)))
    _log.info("no client uses these tools any more; they end")
    return 0


if __name__ == "__main__":
    sys.exit(main())
