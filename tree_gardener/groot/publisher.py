"""A server of Groot2's protocol for a tree that runs here.

Until the first request nothing is attached to the tree, and its ticks cost nothing more. The ticking thread
attaches and detaches the observer and the hooks, by timers that are due at once; the publisher's thread
answers from copies.
"""

import contextlib
import threading
from collections.abc import Callable
from types import TracebackType
from typing import TYPE_CHECKING, Final

from tree_gardener.groot.answers import Answers
from tree_gardener.groot.hooks import Hooks, Waiting
from tree_gardener.groot.libraries import libraries
from tree_gardener.groot.mirror import Mirror
from tree_gardener.groot.protocol import (
    LAST_PORT,
    LONGEST_REQUEST,
    PORT,
    GrootError,
    Header,
    RequestType,
)

if TYPE_CHECKING:
    from tree_gardener.tree import Tree

__all__ = ["ATTACH_S", "LAST_PORT", "LOCALHOST", "PORT", "SILENCE_S", "Groot2Publisher"]

LOCALHOST: Final = "127.0.0.1"
SILENCE_S: Final = 5.0
"""So long after its last request a client counts as gone: hooks are off, and a tree that waits continues."""
ATTACH_S: Final = 0.2
"""So long a request waits for a tick; a tree that makes none is read as it stands."""


class Groot2Publisher:
    """Serves a tree to Groot2, and to every client of its protocol, until it is closed.

    Requests are answered on `port`; the next one carries the news of breakpoints that are reached. While
    clients have hooks, these are the tree's debugger. Any thread may close it, also while the tree waits.

    Args:
        tree: the tree.
        port: the port; the next one is used too.
        host: the address to listen at. The protocol has no password: anyone who reaches it can stop the tree.
        looks_only: whether breakpoints and forced results of clients are refused.
        waiting: entered on the ticking thread while the tree waits at a breakpoint of a client.

    Raises:
        GrootError: the ports cannot be used.
        ModuleNotFoundError: pyzmq or msgpack is not installed.
    """

    def __init__(
        self,
        tree: "Tree",
        port: int = PORT,
        host: str = LOCALHOST,
        *,
        looks_only: bool = False,
        waiting: Waiting = contextlib.nullcontext,
    ) -> None:
        self._zmq, msgpack = libraries()
        if not 0 < port <= LAST_PORT:
            raise GrootError(f"port {port}: Groot2 needs two ports from 1 to {LAST_PORT + 1}")
        self.port = port
        self._tree = tree
        self._mirror = Mirror(tree, msgpack.packb)
        self._hooks = Hooks(tree, self._tell, self._mirror.read, waiting)
        self._answers = Answers(tree, self._mirror, self._hooks, msgpack.packb, looks_only=looks_only)
        self._unobserve: Callable[[], None] | None = None
        self._is_attached = threading.Event()
        self._is_asked = False
        self._numbers = 0
        self._context = self._zmq.Context()
        self._open(host)
        self._thread = threading.Thread(target=self._serve, name="groot2", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Ends the service; a tree that waits at a breakpoint continues."""
        self._hooks.remove_all()
        self._wake_end.send(b"")
        self._thread.join()
        self._soon(self._detach)
        for socket in (self._wake_end, self._told):
            socket.close(linger=0)
        self._context.term()

    def __enter__(self) -> "Groot2Publisher":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _open(self, host: str) -> None:
        zmq = self._zmq
        self._replies = self._context.socket(zmq.REP)
        self._told = self._context.socket(zmq.PUB)
        self._wake, self._wake_end = self._context.socket(zmq.PAIR), self._context.socket(zmq.PAIR)
        self._replies.setsockopt(zmq.MAXMSGSIZE, 2 * LONGEST_REQUEST)
        self._wake.bind("inproc://end")
        self._wake_end.connect("inproc://end")
        try:
            for socket, port in ((self._replies, self.port), (self._told, self.port + 1)):
                socket.bind(f"tcp://{host}:{port}")
        except zmq.ZMQError as error:
            self._context.destroy(linger=0)
            raise GrootError(
                f"Groot2 needs the ports {self.port} and {self.port + 1} of {host}: {error}"
            ) from None

    def _serve(self) -> None:
        """Answers clients until the publisher is closed, on its own thread."""
        zmq = self._zmq
        poller = zmq.Poller()
        for socket in (self._replies, self._wake):
            poller.register(socket, zmq.POLLIN)
        while True:
            found = dict(poller.poll(SILENCE_S * 1000 if self._is_asked else None))
            if self._wake in found:
                break
            if self._replies in found:
                self._reply()
            else:
                self._is_asked = False
                self._hooks.enable_all(on=False)
                self._soon(self._detach)
        for socket in (self._replies, self._wake):
            socket.close(linger=0)

    def _reply(self) -> None:
        parts = self._replies.recv_multipart()
        if not self._is_asked:
            self._is_asked = True
            self._begin()
        self._replies.send_multipart(self._answers.answer(parts))
        if self._hooks.must_follow:
            self._soon(self._hooks.follow)

    def _begin(self) -> None:
        """Attaches to the tree for the first request after a silence."""
        self._hooks.enable_all(on=True)
        self._is_attached.clear()
        self._soon(self._attach)
        if not self._is_attached.wait(ATTACH_S):
            self._mirror.read()

    def _soon(self, callback: Callable[[], None]) -> None:
        """Asks the ticking thread to call a function between two ticks."""
        self._tree.timers.start(0.0, callback)

    def _attach(self) -> None:
        """Begins to observe the tree, on the ticking thread."""
        if self._unobserve is None:
            self._mirror.read()
            self._unobserve = self._tree.observe(self._mirror.ticked)
        self._hooks.follow()
        self._is_attached.set()

    def _detach(self) -> None:
        """Stops observing the tree, on the ticking thread."""
        if self._unobserve is not None:
            self._unobserve()
            self._unobserve = None
        self._hooks.detach()

    def _tell(self, uid: int) -> None:
        """Notifies clients that the hook of a node was reached."""
        self._numbers += 1
        self._told.send_multipart([Header(RequestType.REACHED, self._numbers).pack(), str(uid).encode()])
