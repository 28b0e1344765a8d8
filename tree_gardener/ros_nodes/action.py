"""Actions of ROS as nodes, after ``RosActionNode`` of BehaviorTree.ROS2."""

import importlib
import uuid
from typing import Any, ClassVar, Final

from tree_gardener.ports import node_of
from tree_gardener.ros_nodes.leaf import RosLeaf
from tree_gardener.status import Status

SERVER_UNREACHABLE: Final = "SERVER_UNREACHABLE"
SEND_GOAL_TIMEOUT: Final = "SEND_GOAL_TIMEOUT"
GOAL_REJECTED_BY_SERVER: Final = "GOAL_REJECTED_BY_SERVER"
ACTION_ABORTED: Final = "ACTION_ABORTED"
ACTION_CANCELLED: Final = "ACTION_CANCELLED"
INVALID_GOAL: Final = "INVALID_GOAL"

_SUCCEEDED, _CANCELED = 4, 5  # action_msgs/msg/GoalStatus


class SentGoal:
    """A goal that was sent to a server. Ticks check its state; nothing waits.

    Attributes:
        sent_s: when it was sent.
        feedback: the feedback that was not looked at yet; None if there is none.
        handle: the handle, after the server accepted the goal.
    """

    def __init__(self, client: Any, goal: Any, sent_s: float) -> None:
        self.sent_s = sent_s
        self.feedback: Any = None
        self.handle: Any = None
        self._result: Any = None
        self._client = client
        self._id = _new_id()
        self._sending = client.send_goal_async(goal, feedback_callback=self._heard, goal_uuid=self._id)

    @property
    def is_answered(self) -> bool:
        """Whether the server answered; if it accepted the goal, `handle` is set and the result requested."""
        if self.handle is None and self._sending.done():
            answer = self._sending.result()
            if answer is not None and answer.accepted:
                self.handle = answer
                self._result = answer.get_result_async()
        return bool(self._sending.done())

    @property
    def outcome(self) -> Any:
        """The server's response with status and result, or None."""
        return self._result.result() if self._result is not None and self._result.done() else None

    def take_feedback(self) -> Any:
        """Returns the latest feedback once, or None."""
        feedback, self.feedback = self.feedback, None
        return feedback

    def cancel(self) -> None:
        """Asks the server to stop, also if it has not answered yet.

        A server handles the goal before the request that follows it. So the request is sent at once: a run
        that ends now would not hear the answer. It is repeated for a server that accepts the goal later.
        """
        if not self._sending.done():
            from rclpy.action.client import ClientGoalHandle  # noqa: PLC0415 - the engine works without ROS

            ClientGoalHandle(self._client, self._id, None).cancel_goal_async()
        self._sending.add_done_callback(_cancel)

    def _heard(self, message: Any) -> None:
        self.feedback = message.feedback


class RosActionNode(RosLeaf):
    """The base of nodes that send a goal to an action server and are RUNNING until it has a result.

    A derived class sets `ACTION_TYPE` and `ACTION_NAME`, and overrides the ``on_…`` functions and `set_goal`.
    The ports ``action_name`` (or that which `NAME_PORT` names), ``server_timeout`` and
    ``wait_for_server_timeout`` replace the attributes if the class declares them. A tick never waits: until
    the server is there, the node is RUNNING.
    """

    ACTION_TYPE: ClassVar[str] = ""
    ACTION_NAME: ClassVar[str] = ""
    NAME_PORT: ClassVar[str] = "action_name"
    SERVER_TIMEOUT_MS: ClassVar[int] = 1000
    """The time in which the server has to accept the goal."""
    WAIT_FOR_SERVER_TIMEOUT_MS: ClassVar[int] = 500
    """The time in which the server has to appear; negative forever."""

    _type: Any = None
    _client: Any = None
    _client_name = ""
    _sent: SentGoal | None = None
    _seen_s = 0.0

    def set_goal(self, goal: Any) -> Any:
        """Fills the goal. Returns another goal to send instead, or False if there is nothing to send."""

    def on_feedback(self, _feedback: Any) -> Any:
        """Handles the feedback; SUCCESS or FAILURE cancels the goal and ends the node."""
        return Status.RUNNING

    def on_result(self, _result: Any) -> Any:
        """Handles the result of a goal that was reached."""
        return Status.SUCCESS

    def on_aborted(self, _result: Any) -> Any:
        """Handles the result of a goal that the server gave up."""
        return self.on_failure(ACTION_ABORTED)

    def on_cancelled(self, _result: Any) -> Any:
        """Handles the result of a goal that was cancelled."""
        return self.on_failure(ACTION_CANCELLED)

    def on_failure(self, _error: str) -> Any:
        """Returns the result of the node after an error, which is one of the names of this module."""
        return Status.FAILURE

    def on_halt(self) -> None:
        """Is called when the node is halted; the goal is cancelled without it."""

    def setup(self, **kwargs: Any) -> None:
        """Makes the client, if the name of the action is known already."""
        super().setup(**kwargs)
        if self.ros is None:
            return
        if self.literal("action_type") or "action_type" not in node_of(self).ports:
            self._resolve()
            self.check()
        if self.literal(self.NAME_PORT) or self.NAME_PORT not in node_of(self).ports:
            self._connect()

    def check(self) -> None:
        """Finds mistakes in the ports before the first tick."""

    def initialise(self) -> None:
        """Begins an activation."""
        self._sent = None
        self._resolve()
        self._connect()
        self._seen_s = self.now()

    def update(self) -> Any:
        """Sends the goal, or follows the goal that was sent."""
        return self._send() if self._sent is None else self._follow(self._sent)

    def terminate(self, new_status: Any) -> None:
        """Cancels the goal if the node is halted."""
        if new_status.name == "INVALID":
            sent, self._sent = self._sent, None
            if sent is not None:
                sent.cancel()
            self.on_halt()

    def shutdown(self) -> None:
        """Destroys the client."""
        if self._client is not None:
            self._client.destroy()
            self._client = None

    def _resolve(self) -> None:
        if self._type is None:
            self.joined()
            self._type = self.interface("action_type", self.ACTION_TYPE, "action")

    def _connect(self) -> None:
        name = self.ros_name(self.NAME_PORT, self.ACTION_NAME)
        if self._client is not None and name == self._client_name:
            return
        from rclpy.action import ActionClient  # noqa: PLC0415 - the engine works without ROS

        self.shutdown()
        self._client = ActionClient(self.joined(), self._type, name)
        self._client_name = name

    def _send(self) -> Any:
        now_s = self.now()
        if not self._client.server_is_ready():
            patience_s = self.seconds("wait_for_server_timeout", self.WAIT_FOR_SERVER_TIMEOUT_MS)
            is_patient = patience_s < 0 or now_s - self._seen_s < patience_s
            return Status.RUNNING if is_patient else self.on_failure(SERVER_UNREACHABLE)
        goal = self._type.Goal()
        given = self.set_goal(goal)
        if given is False:
            return self.on_failure(INVALID_GOAL)
        if given is None or given is True:
            given = goal
        self._sent, self._seen_s = SentGoal(self._client, given, now_s), now_s
        return Status.RUNNING

    def _follow(self, sent: SentGoal) -> Any:  # noqa: PLR0911 - the steps of a goal
        patience_s = self.seconds("server_timeout", self.SERVER_TIMEOUT_MS)
        now_s = self.now()
        if not sent.is_answered:
            if patience_s < 0 or now_s - sent.sent_s <= patience_s:
                return Status.RUNNING
            sent.cancel()
            return self.on_failure(SEND_GOAL_TIMEOUT)
        if sent.handle is None:
            return self.on_failure(GOAL_REJECTED_BY_SERVER)
        feedback = sent.take_feedback()
        if feedback is not None:
            wanted = self.on_feedback(feedback)
            if wanted is not None and wanted.name != "RUNNING":
                sent.cancel()
                return wanted
        outcome = sent.outcome
        if outcome is None:
            return self._missed(now_s, patience_s)
        if outcome.status == _SUCCEEDED:
            return self.on_result(outcome.result)
        return (self.on_cancelled if outcome.status == _CANCELED else self.on_aborted)(outcome.result)

    def _missed(self, now_s: float, patience_s: float) -> Any:
        """Returns RUNNING, or the result of `on_failure` if the server has been gone for the timeout."""
        if self._client.server_is_ready():
            self._seen_s = now_s
        elif 0 <= patience_s < now_s - self._seen_s:
            return self.on_failure(SERVER_UNREACHABLE)
        return Status.RUNNING


class RosAction(RosActionNode):
    """Sends a goal to an action server; the fields of goal, result and feedback are ports."""

    def check(self) -> None:
        """Compares the ports with the fields of the action."""
        for prefix in ("goal", "result", "feedback"):
            self.check_fields(getattr(self._type, prefix.title())(), prefix)

    def set_goal(self, goal: Any) -> Any:
        """Fills the goal from the ports."""
        return self.fill(goal, "goal")

    def on_feedback(self, feedback: Any) -> Status:
        """Writes the fields of the feedback that the tree uses."""
        self.give_fields(feedback, "feedback")
        return Status.RUNNING

    def on_result(self, result: Any) -> Status:
        """Writes the fields of the result that the tree uses."""
        self.give_fields(result, "result")
        self.give("error", "")
        return Status.SUCCESS

    def on_aborted(self, result: Any) -> Status:
        """Writes the fields of the result, which may say why."""
        self.give_fields(result, "result")
        return self.on_failure(ACTION_ABORTED)

    def on_cancelled(self, result: Any) -> Status:
        """Writes the fields of the result, which may say why."""
        self.give_fields(result, "result")
        return self.on_failure(ACTION_CANCELLED)

    def on_failure(self, error: str) -> Status:
        """Writes the error; a missing server gives the result that the tree wants."""
        self.give("error", error)
        is_missing = error == SERVER_UNREACHABLE
        return self.result("if_missing", Status.FAILURE) if is_missing else Status.FAILURE


def _new_id() -> Any:
    found = importlib.import_module("unique_identifier_msgs.msg").UUID()
    found.uuid = list(uuid.uuid4().bytes)
    return found


def _cancel(sending: Any) -> None:
    handle = sending.result()
    if handle is not None and handle.accepted:
        handle.cancel_goal_async()
