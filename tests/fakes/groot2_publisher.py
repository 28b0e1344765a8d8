"""A publisher of Groot2's protocol that answers wrongly: the failure that a client must outlive."""

from __future__ import annotations

import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING

import zmq

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@contextmanager
def wrong_publisher(port: int, answer: Callable[[list[bytes]], list[bytes]]) -> Iterator[None]:
    """Answers each request with the reply that a function makes of it."""
    context = zmq.Context()
    socket = context.socket(zmq.REP)
    socket.bind(f"tcp://127.0.0.1:{port}")

    def serve() -> None:
        while not is_over.is_set():
            if socket.poll(20):
                socket.send_multipart(answer(socket.recv_multipart()))

    is_over = threading.Event()
    thread = threading.Thread(target=serve)
    thread.start()
    try:
        yield
    finally:
        is_over.set()
        thread.join()
        context.destroy(linger=0)


@contextmanager
def leaving_publisher(port: int, then: Callable[[], None]) -> Iterator[None]:
    """Takes one request and ends without an answer; `then` is called after it."""
    context = zmq.Context()
    socket = context.socket(zmq.REP)
    socket.bind(f"tcp://127.0.0.1:{port}")

    def serve() -> None:
        socket.recv_multipart()
        context.destroy(linger=0)
        then()

    thread = threading.Thread(target=serve)
    thread.start()
    try:
        yield
    finally:
        thread.join()
