"""`python -m executor.tools`: serves one user's editors until it has no clients.

In a container it fetches its socket from the gate; in a pod it listens on the network, with TLS.
"""

from __future__ import annotations

import argparse
import asyncio
import logging
import os
import signal
import socket
import sys
from pathlib import Path

from executor.manager.gate import fetch_listener
from executor.manager.tls import CertificateError, server_context
from executor.tools.server import ToolsServer

_log = logging.getLogger(__name__)


async def _serve(server: ToolsServer) -> None:
    loop = asyncio.get_running_loop()
    for number in (signal.SIGTERM, signal.SIGINT):
        loop.add_signal_handler(number, server.end)
    await server.run()


def _listen(options: argparse.Namespace, token: str) -> socket.socket:
    if options.gate:
        return fetch_listener(options.gate, options.session, token)
    family = socket.AF_INET6 if ":" in options.host else socket.AF_INET
    return socket.create_server((options.host, options.port), family=family)


def main(arguments: list[str] | None = None) -> int:
    """Runs the command line; returns the exit status."""
    parser = argparse.ArgumentParser(prog="python -m executor.tools", description=__doc__)
    parser.add_argument("--gate", type=Path, help="unix socket that hands out our own")
    parser.add_argument("--session", default="", help="our id, for the gate")
    parser.add_argument("--host", default="", help="address on which we listen without a gate, with TLS")
    parser.add_argument("--port", type=int, default=0, help="port on which we listen without a gate")
    parser.add_argument("--tls-cert", default="", help="our certificate, as PEM")
    parser.add_argument("--tls-key", default="", help="its key, as PEM")
    parser.add_argument("--token-env", required=True, help="environment variable that holds the token")
    parser.add_argument("--grace", type=float, default=600.0, help="seconds that we stay without clients")
    options = parser.parse_args(arguments)
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(levelname)s %(name)s: %(message)s")
    logging.getLogger("websockets").setLevel(logging.WARNING)
    if bool(options.gate) == bool(options.host):
        parser.error("one of --gate and --host is given")
    if options.host and not (options.tls_cert and options.tls_key):
        parser.error("--host is given together with --tls-cert and --tls-key")
    token = os.environ.pop(options.token_env, "")
    if not token:
        parser.error(f"the environment variable {options.token_env} of --token-env holds no token")
    try:
        tls = server_context(options.tls_cert, options.tls_key)
        listener = _listen(options, token)
    except CertificateError as error:
        parser.error(str(error))
    except OSError as error:
        place = f"from the gate {options.gate}" if options.gate else f"at {options.host}:{options.port}"
        sys.stderr.write(f"tools: no socket {place}: {error}\n")
        return 1
    with listener:
        asyncio.run(_serve(ToolsServer(listener, token, grace_s=options.grace, tls=tls)))
    _log.info("no client uses these tools any more; they end")
    return 0


if __name__ == "__main__":
    sys.exit(main())
