"""Publishes on a separate thread, so that a frozen subscriber does not block the world.

Fast DDS delivers messages in shared memory. A process that is stopped (by a debugger, SIGSTOP) may hold the
lock of that memory; a publisher then waits for up to three seconds. rclpy holds the interpreter lock while it
publishes, so a thread alone would not help: this module calls rcl directly.
"""

from __future__ import annotations

import contextlib
import ctypes
import threading
from collections import deque
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from rclpy.impl.implementation_singleton import rclpy_implementation

from executor.recorder.cdr import encode_object
from executor.ros.tap import kind_of

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Outlet", "Piped", "RclPublish"]

DEPTH: Final = 5
"""Queue length of a topic; if the queue is full, the oldest message is dropped."""
PATIENCE_S: Final = 0.02


class _Array(ctypes.Structure):
    """The C type `rcl_serialized_message_t`. Its allocator is not used, since nothing is resized."""

    _fields_ = (
        ("buffer", ctypes.c_char_p),
        ("length", ctypes.c_size_t),
        ("capacity", ctypes.c_size_t),
        ("allocator", ctypes.c_void_p * 5),
    )


class RclPublish:
    """Publishes a serialized message without the interpreter's lock."""

    def __init__(self) -> None:
        # rclpy has loaded the library; loading it by name returns the same.
        library = ctypes.CDLL(_loaded("librcl.so"))
        self._publish = library.rcl_publish_serialized_message
        self._publish.argtypes = (ctypes.c_void_p, ctypes.POINTER(_Array), ctypes.c_void_p)
        self._publish.restype = ctypes.c_int

    def __call__(self, publisher: Any, data: bytes) -> None:
        """Sends a message; ignores a failure, like a topic without subscribers."""
        array = _Array(data, len(data), len(data))
        with contextlib.suppress(rclpy_implementation.InvalidHandle), publisher.handle:
            self._publish(publisher.handle.pointer, ctypes.byref(array), None)


class Outlet:
    """Sends messages in order on a thread; its methods block for a moment at most.

    Args:
        send: sends one serialized message of a publisher; may block.
    """

    def __init__(self, send: Callable[[Any, bytes], None] | None = None) -> None:
        self._send = send or RclPublish()
        self._waiting: deque[tuple[Any, bytes]] = deque()
        self._counts: dict[int, int] = {}
        self._changed = threading.Condition()
        self._is_closed = False
        self._is_late = False
        self._is_sending = False
        self.left_out = 0
        self._thread = threading.Thread(target=self._work, name="outlet", daemon=True)
        self._thread.start()

    def publish(self, publisher: Any, message: Any) -> None:
        """Encodes and queues a message; the caller may change the message afterwards.

        ROS's own serializer leaves bytes behind the values of some types, of joint states for one, and other
        readers of a recording refuse those.
        """
        self.put(publisher, encode_object(kind_of(message), message))

    def put(self, publisher: Any, data: bytes) -> None:
        """Queues a serialized message."""
        with self._changed:
            count = self._counts.get(id(publisher), 0)
            if count >= DEPTH:
                self._leave_out(publisher)
            else:
                self._counts[id(publisher)] = count + 1
            self._waiting.append((publisher, data))
            self._changed.notify_all()

    def flush(self) -> None:
        """Waits a moment until the thread has sent the queue."""
        with self._changed:
            patience_s = 0.0 if self._is_late else PATIENCE_S
            self._is_late = not self._changed.wait_for(self._is_done, patience_s)

    def close(self) -> None:
        """Stops the thread; queued messages are lost."""
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()
        self._thread.join(PATIENCE_S)

    def _is_done(self) -> bool:
        return not self._waiting and not self._is_sending

    def _leave_out(self, publisher: Any) -> None:
        at = next(i for i, (other, _) in enumerate(self._waiting) if other is publisher)
        del self._waiting[at]
        self.left_out += 1

    def _work(self) -> None:
        while True:
            with self._changed:
                self._is_sending = False
                self._changed.notify_all()
                self._changed.wait_for(lambda: bool(self._waiting) or self._is_closed)
                if self._is_closed:
                    return
                publisher, data = self._waiting.popleft()
                self._counts[id(publisher)] -= 1
                self._is_sending = True
            self._send(publisher, data)


class Piped:
    """A publisher that sends through an outlet."""

    def __init__(self, publisher: Any, outlet: Outlet) -> None:
        self._publisher = publisher
        self._outlet = outlet

    @property
    def topic_name(self) -> str:
        """The name of the topic."""
        return str(self._publisher.topic_name)

    def publish(self, message: Any) -> None:
        """Queues a message."""
        self._outlet.publish(self._publisher, message)

    def get_subscription_count(self) -> int:
        """Returns the number of subscribers."""
        return int(self._publisher.get_subscription_count())


def _loaded(name: str) -> str:
    """Returns the path of a library that this process has loaded."""
    for line in Path("/proc/self/maps").read_text(encoding="utf-8").splitlines():
        path = line.rpartition(" ")[2]
        if Path(path).name.startswith(name):
            return path
    raise OSError(f"{name} is not loaded")
