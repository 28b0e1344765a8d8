"""Runs trees by name on request, after ``TreeExecutionServer`` of BehaviorTree.ROS2.

It serves ``btcpp_ros2_interfaces/action/ExecuteTree``. There, every goal is accepted, and one that comes
while a tree runs waits for its end. Here, the parameter ``on_new_goal`` decides.
"""

from collections import deque
from collections.abc import Callable
from functools import partial
from typing import Any, Final

import tree_gardener.ros_wheels  # noqa: F401 - refuses two ROS before rclpy is loaded

from rclpy.action import ActionServer, CancelResponse, GoalResponse

from tree_gardener.blackboard import Blackboard
from tree_gardener.errors import LoadError, TickError, in_full
from tree_gardener.ros import RosRunner
from tree_gardener.ros_entities import OpenedSince
from tree_gardener.ros_parameters import PREEMPT, REJECT
from tree_gardener.ros_payload import PayloadError, blackboard_of
from tree_gardener.ros_spinning import LAST_ZEROS
from tree_gardener.status import Status
from tree_gardener.tree import Tree

# The texts are those of TreeExecutionServer, by which clients may tell the cases apart.
CANCELLED: Final = "Action Server canceling and halting Behavior Tree"
FINISHED: Final = "Tree finished with status: "
EXCEPTION: Final = "Behavior Tree exception: "
PREEMPTED: Final = "Preempted by a new goal"
SHUT_DOWN: Final = "The server was shut down"
_NUMBERS: Final = {
    Status.IDLE: 0,
    Status.RUNNING: 1,
    Status.SUCCESS: 2,
    Status.FAILURE: 3,
    Status.SKIPPED: 4,
}
_KEPT_S: Final = 10

Load = Callable[[str, Blackboard], Tree]
"""Builds the tree of a name; '' is the main tree."""


class _Goal:
    """A goal whose tree runs."""

    def __init__(self, handle: Any, runner: RosRunner, opened: OpenedSince) -> None:
        self.handle = handle
        self.runner = runner
        self.opened = opened
        self.tick = 0


class _Server(ActionServer):
    """An action server whose goals are worked on in steps: no task of rclpy polls meanwhile."""

    def __init__(self, accepted: Callable[[Any], None], *arguments: Any, **more: Any) -> None:
        self._accepted = accepted
        super().__init__(*arguments, **more)

    def notify_execute(self, goal_handle: Any, execute_callback: Any) -> None:
        """Takes over an accepted goal, where rclpy would begin a task for it."""
        self._accepted(goal_handle)

    def end(self, handle: Any, event: str, result: Any) -> None:
        """Ends a goal: ``succeed``, ``abort`` or ``canceled``; sends its result."""
        getattr(handle, event)()
        super().notify_execute(handle, lambda _handle: result)


class TreeServer:
    """Serves the trees of a document on a node.

    Args:
        node: the node, whose executor spins in the thread that calls `step`.
        action_name: the name of the action.
        load: builds a tree.
        on_new_goal: the handling of a goal that arrives while a tree runs.
        callback_group: the group of the server and of the ticks.
        runner: arguments of `RosRunner`, such as ``tick_hz``.
    """

    def __init__(
        self, node: Any, *, action_name: str, load: Load, on_new_goal: str, callback_group: Any, **runner: Any
    ) -> None:
        from btcpp_ros2_interfaces.action import ExecuteTree  # noqa: PLC0415 - no other part needs the package

        self._node = node
        self._log = node.get_logger()
        self._load = load
        self._on_new_goal = on_new_goal
        self._kind = ExecuteTree
        self._group = callback_group
        self._options = runner
        self._waiting: deque[Any] = deque()
        self._running: _Goal | None = None
        self._server = _Server(
            self._waiting.append,
            node,
            ExecuteTree,
            action_name,
            lambda _handle: ExecuteTree.Result(),
            callback_group=callback_group,
            goal_callback=self._judge,
            cancel_callback=lambda _handle: CancelResponse.ACCEPT,
            result_timeout=_KEPT_S,
        )

    def step(self) -> None:
        """Handles cancelled goals, new goals, feedback, and the end of the tree."""
        for handle in [each for each in self._waiting if each.is_cancel_requested]:
            self._waiting.remove(handle)
            self._end(handle, "canceled", Status.IDLE, CANCELLED)
        goal = self._running
        if goal is not None:
            self._look_at(goal)
        if self._running is not None and self._waiting and self._on_new_goal == PREEMPT:
            self._stop(self._running, "abort", PREEMPTED)
        while self._running is None and self._waiting:
            newest = self._on_new_goal == PREEMPT
            while newest and len(self._waiting) > 1:
                self._end(self._waiting.popleft(), "abort", Status.IDLE, PREEMPTED)
            self._begin(self._waiting.popleft())

    def fail(self, error: BaseException) -> bool:
        """Ends the tree that runs after an exception outside of a tick; returns whether one runs."""
        goal = self._running
        if goal is not None:
            goal.runner.fail(error)
        return goal is not None

    def stop(self, await_answers: Callable[[], None]) -> None:
        """Halts the tree and aborts all goals; the executor sends their results.

        Args:
            await_answers: waits for the servers whose goals the tree cancelled.
        """
        goal = self._running
        if goal is not None:
            goal.runner.stop()
            await_answers()
            self._node.commanded.stop(LAST_ZEROS)
            self._stop(goal, "abort", SHUT_DOWN)
        while self._waiting:
            self._end(self._waiting.popleft(), "abort", Status.IDLE, SHUT_DOWN)

    def close(self) -> None:
        """Ends the server."""
        self._server.destroy()

    def _judge(self, request: Any) -> GoalResponse:
        self._log.info(f"Received goal request to execute Behavior Tree: {request.target_tree}")
        is_busy = self._running is not None or bool(self._waiting)
        if is_busy and self._on_new_goal == REJECT:
            self._log.warning(f"the goal '{request.target_tree}' is rejected: another tree runs")
            return GoalResponse.REJECT
        return GoalResponse.ACCEPT

    def _begin(self, handle: Any) -> None:
        request = handle.request
        opened = OpenedSince(self._node)
        try:
            tree = self._load(request.target_tree, blackboard_of(request.payload))
            runner = RosRunner(
                tree, self._node, finished=self._note_end, callback_group=self._group, **self._options
            )
        except PayloadError as error:
            problem = str(error)
        except LoadError as error:
            problem = "; ".join(map(str, error.diagnostics))
        except TickError as error:  # the `setup` of an action
            problem = str(error)
            self._log.error(in_full(error))
        except OSError as error:
            problem = f"{error.filename} cannot be read: {error.strerror}"
        else:
            goal = self._running = _Goal(handle, runner, opened)
            tree.observe(partial(self._tell, goal))
            return
        opened.close()
        self._end(handle, "abort", Status.IDLE, EXCEPTION + problem)

    def _note_end(self, _status: Status) -> None:
        """The runner knows its end; `step` is called after each callback and sees it."""

    def _tell(self, goal: _Goal, _changes: Any) -> None:
        """Publishes which leaves run, after each tick."""
        tree = goal.runner.runner.tree
        if tree.tick_number == goal.tick or not goal.handle.is_active:
            return  # a halt, not a tick
        goal.tick = tree.tick_number
        running = [node.path for node in tree.nodes if node.status is Status.RUNNING and not node.children]
        goal.handle.publish_feedback(
            self._kind.Feedback(message=f"tick {goal.tick}: {', '.join(running) or 'no node is RUNNING'}")
        )

    def _look_at(self, goal: _Goal) -> None:
        runner = goal.runner.runner
        if runner.is_finished:
            error, status = runner.error, runner.status
            if error is not None:
                self._close(goal)
                self._end(goal.handle, "abort", Status.FAILURE, EXCEPTION + str(error))
                return
            self._close(goal)
            event = "succeed" if status is Status.SUCCESS else "abort"
            self._end(goal.handle, event, status, FINISHED + status.name)
        elif goal.handle.is_cancel_requested:
            self._stop(goal, "canceled", CANCELLED)

    def _stop(self, goal: _Goal, event: str, message: str) -> None:
        if goal.handle.is_cancel_requested:
            event = "canceled"
        self._close(goal)
        self._end(goal.handle, event, Status.RUNNING, message)

    def _close(self, goal: _Goal) -> None:
        self._running = None
        goal.runner.shutdown()
        self._node.commanded.end()
        goal.opened.close()

    def _end(self, handle: Any, event: str, status: Status, message: str) -> None:
        result = self._kind.Result(return_message=message)
        result.node_status.status = _NUMBERS[status]
        # rclpy refuses one place that logs with two severities.
        if event == "succeed":
            self._log.info(message)
        else:
            self._log.warning(message)
        self._server.end(handle, event, result)
