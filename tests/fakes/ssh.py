"""A fake of `ssh -N -L … -- HOST`: it forwards ports on this computer, and writes down what it was asked.

The variable FAKE_SSH names the file for its arguments. For the host `refused` it ends as ssh does without a
connection.
"""

from __future__ import annotations

import os
import select
import socket
import sys
import threading
from pathlib import Path

CHUNK = 1 << 16


def main(arguments: list[str]) -> int:
    """Forwards until it is ended."""
    Path(os.environ["FAKE_SSH"]).write_text("\n".join(arguments), encoding="utf-8")
    if arguments[-1] == "refused":
        sys.stderr.write("ssh: connect to host refused port 22: Connection refused\n")
        return 255
    forwards = [arguments[at + 1] for at, word in enumerate(arguments) if word == "-L"]
    listeners = {}
    for forward in reversed(forwards):  # the first one, for which the user waits, is open last
        host, port, _, far = forward.split(":")
        listeners[socket.create_server((host, int(port)))] = int(far)
    while True:
        for listener in select.select(list(listeners), [], [])[0]:
            near, _ = listener.accept()
            threading.Thread(target=_forward, args=(near, listeners[listener]), daemon=True).start()


def _forward(near: socket.socket, port: int) -> None:
    try:
        far = socket.create_connection(("127.0.0.1", port))
    except OSError:
        near.close()
        return
    with near, far:
        others = {near: far, far: near}
        while True:
            for source in select.select([near, far], [], [])[0]:
                data = source.recv(CHUNK)
                if not data:
                    return
                others[source].sendall(data)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
