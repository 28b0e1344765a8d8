"""A manager that does what its second argument says: the launcher's zoo of bad back ends.

echo          listens; answers each message with itself, tells its path and token first
flood         listens; sends frames as fast as the socket takes them, a byte in a file for each
slow          listens after a second
never         never reports that it is ready
failing       ends at once with status 3
stubborn      listens, has a child in a session of its own, ignores SIGTERM
deaf          listens, reads what comes, and answers nothing at all
old           listens, and knows no /watch
held          answers that a debugger holds its tree
mute          says something else than its port

One with `--attach -` writes its standard input to its output. One with `--host=`, `--port=`, `--tls-cert=`
and `--tls-key=` listens there, as in a pod.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import signal
import ssl
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosedError


async def echo(socket: ServerConnection) -> None:
    request = socket.request
    assert request is not None
    await socket.send(
        json.dumps(
            {
                "path": request.path,
                "authorization": request.headers.get("Authorization"),
                "user": request.headers.get("X-BT-Studio-User"),
            }
        )
    )
    with contextlib.suppress(ConnectionClosedError):  # a client may be killed
        async for message in socket:
            if message == "close":
                await socket.close(4321, "as asked")
            elif message == "hang":
                time.sleep(3600)  # noqa: ASYNC251 - the loop is what hangs
            elif message == "die":
                os._exit(9)
            else:
                await socket.send(message)


async def flood(socket: ServerConnection) -> None:
    with Path(os.environ["FAKE_MANAGER_COUNTER"]).open("ab", buffering=0) as counter:  # noqa: ASYNC230
        while True:
            await socket.send(bytes(100_000))
            counter.write(b".")


async def listen_in_pod(given: dict[str, str]) -> None:
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(given["--tls-cert"], given["--tls-key"])
    options: Any = {"compression": None, "max_size": None, "ssl": context}
    async with serve(echo, given["--host"], int(given["--port"]), **options):
        await asyncio.get_running_loop().create_future()


async def listen(kind: str, ready_fd: int) -> None:
    handler = flood if kind == "flood" else echo
    refusal = {"old": refuse_watch, "held": tell_held}.get(kind)
    options: Any = {"compression": None, "max_queue": 2, "max_size": None, "process_request": refusal}
    async with (
        await asyncio.start_server(read_only, "127.0.0.1", 0)
        if kind == "deaf"
        else serve(handler, "127.0.0.1", 0, **options) as server
    ):
        port = next(iter(server.sockets)).getsockname()[1]
        os.write(ready_fd, json.dumps({"port": port}).encode() + b"\n")
        os.close(ready_fd)
        await asyncio.get_running_loop().create_future()


def refuse_watch(connection: ServerConnection, request):
    return connection.respond(404, "There is no such thing.") if request.path == "/watch" else None


def tell_held(connection: ServerConnection, request):
    return connection.respond(200, '{"state": "held"}') if request.path == "/health" else None


async def read_only(reader: asyncio.StreamReader, _: asyncio.StreamWriter) -> None:
    while await reader.read(1 << 16):
        pass


def repeat() -> None:
    sys.stdout.write(sys.stdin.readline())
    sys.stdout.flush()


def main() -> None:
    kind, arguments = sys.argv[1], sys.argv[2:]
    given = dict(argument.split("=", 1) for argument in arguments if "=" in argument)
    if "--tls-cert" in given:
        asyncio.run(listen_in_pod(given))
        return
    ready_fd = int(arguments[arguments.index("--ready-fd") + 1])
    sys.stdout.write("the fake manager starts\n")
    sys.stdout.flush()
    if "-" in arguments:
        threading.Thread(target=repeat, daemon=True).start()
    if kind == "failing":
        sys.exit(3)
    if kind == "never":
        time.sleep(3600)  # it does nothing until it is killed
    if kind == "slow":
        time.sleep(1)  # a start that takes a while
    if kind == "mute":
        os.write(ready_fd, b"hello\n")
        time.sleep(3600)  # it does nothing until it is killed
    if kind == "stubborn":
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        subprocess.Popen(["sleep", "3600"], start_new_session=True)
    asyncio.run(listen(kind, ready_fd))


if __name__ == "__main__":
    main()
