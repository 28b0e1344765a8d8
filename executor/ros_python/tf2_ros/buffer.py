"""`Buffer`: looks up transforms, and waits for them."""

from __future__ import annotations

import time as wall
from typing import TYPE_CHECKING, Any

from rclpy.clock import Clock, JumpThreshold
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.task import Future
from tf2_py import BufferCore
from tf2_ros.buffer_interface import BufferInterface

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Buffer"]

POLL_S = 0.01


class Buffer(BufferCore, BufferInterface):
    """Stores the transforms that a `TransformListener` receives.

    With a node, the buffer offers the service `tf2_frames`, and removes its samples when the node's time
    jumps back. While `lookup_transform` waits, it reads the messages of its listeners itself, since a
    single-threaded executor is blocked in the callback that waits. In lock-step no time passes during a
    callback, so it does not wait.
    """

    def __init__(self, cache_time: Any = None, node: Any = None) -> None:
        BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        self._waiting: list[Callable[[], None]] = []
        self._listeners: list[Any] = []
        self.clock = Clock() if node is None else node.get_clock()
        if node is not None:
            self._offer_frames(node)
        threshold = JumpThreshold(
            min_forward=None, min_backward=Duration(nanoseconds=-1), on_clock_change=True
        )
        self.jump_handle = self.clock.create_jump_callback(threshold, post_callback=self.time_jump_callback)

    def time_jump_callback(self, time_jump: Any) -> None:
        """Removes all samples after a jump of time."""
        get_logger("tf2_buffer").warning("Detected jump back in time. Clearing tf buffer.")
        self.clear()

    def set_transform(self, transform: Any, authority: str = "default_authority") -> None:
        """Stores the transform of a frame at the time of its stamp."""
        super().set_transform(transform, authority)
        self._tell_waiting()

    def set_transform_static(self, transform: Any, authority: str = "default_authority") -> None:
        """Stores a transform that is valid at all times."""
        super().set_transform_static(transform, authority)
        self._tell_waiting()

    def lookup_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Any = None) -> Any:
        """Returns the transform from `source_frame` into `target_frame`; waits for it up to `timeout`.

        Raises:
            TransformException: the transform is not known; the subclass tells the reason.
        """
        self._wait(lambda: self.can_transform_core(target_frame, source_frame, time)[0], timeout)
        return self.lookup_transform_core(target_frame, source_frame, time)

    def lookup_transform_full(  # noqa: PLR0913, PLR0917 - as in tf2
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
    ) -> Any:
        """Returns the transform from one frame at one time into another frame at another time.

        Waits for it up to `timeout`.
        """
        ways = (target_frame, target_time, source_frame, source_time, fixed_frame)
        self._wait(lambda: self.can_transform_full_core(*ways)[0], timeout)
        return self.lookup_transform_full_core(*ways)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Any = None,
        return_debug_tuple: bool = False,  # noqa: FBT001, FBT002 - as in tf2
    ) -> Any:
        """Returns whether a transform is known, after waiting for it up to `timeout`.

        With `return_debug_tuple` also the reason.
        """
        self._wait(lambda: self.can_transform_core(target_frame, source_frame, time)[0], timeout)
        result = self.can_transform_core(target_frame, source_frame, time)
        return result if return_debug_tuple else result[0]

    def can_transform_full(  # noqa: PLR0913, PLR0917 - as in tf2
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
        return_debug_tuple: bool = False,  # noqa: FBT001, FBT002 - as in tf2
    ) -> Any:
        """Returns whether a transform between two times is known, after waiting for it up to `timeout`."""
        ways = (target_frame, target_time, source_frame, source_time, fixed_frame)
        self._wait(lambda: self.can_transform_full_core(*ways)[0], timeout)
        result = self.can_transform_full_core(*ways)
        return result if return_debug_tuple else result[0]

    async def lookup_transform_async(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """Waits until a transform is known, and returns it."""
        await self.wait_for_transform_async(target_frame, source_frame, time)
        return self.lookup_transform_core(target_frame, source_frame, time)

    async def lookup_transform_full_async(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> Any:
        """Waits until a transform between two times is known, and returns it."""
        ways = (target_frame, target_time, source_frame, source_time, fixed_frame)
        await self.wait_for_transform_full_async(*ways)
        return self.lookup_transform_full_core(*ways)

    def wait_for_transform_async(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """Returns a future that is completed when the transform is known."""
        ways = (target_frame, source_frame, time)
        return self._future(
            lambda: self.can_transform_core(*ways)[0], lambda: self.lookup_transform_core(*ways)
        )

    def wait_for_transform_full_async(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> Any:
        """Returns a future that is completed when the transform between two times is known."""
        ways = (target_frame, target_time, source_frame, source_time, fixed_frame)
        return self._future(
            lambda: self.can_transform_full_core(*ways)[0], lambda: self.lookup_transform_full_core(*ways)
        )

    def _wait(self, is_there: Callable[[], bool], timeout: Any) -> None:
        end_s = wall.monotonic() + (0.0 if timeout is None else timeout.nanoseconds * 1e-9)
        while not is_there():
            for listener in list(self._listeners):
                listener._take()
            passes = not self._listeners or any(listener._time_passes for listener in self._listeners)
            if is_there() or not passes or wall.monotonic() >= end_s:
                return
            wall.sleep(POLL_S)

    def _future(self, is_there: Callable[[], bool], look_up: Callable[[], Any]) -> Any:
        future = Future()

        def look() -> None:
            if not future.done() and is_there():
                future.set_result(look_up())

        look()
        if not future.done():
            self._waiting.append(look)
            future.add_done_callback(lambda _: self._waiting.remove(look))
        return future

    def _tell_waiting(self) -> None:
        for look in list(self._waiting):
            look()

    def _offer_frames(self, node: Any) -> None:
        from tf2_msgs.srv import FrameGraph  # noqa: PLC0415 - built at set-up, may be missing

        def answer(_request: Any, response: Any) -> Any:
            response.frame_yaml = self.all_frames_as_yaml()
            return response

        self.srv = node.create_service(FrameGraph, "tf2_frames", answer)
