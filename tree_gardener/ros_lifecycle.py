"""Runs a tree as a managed node: the services of ROS 2's life cycle configure it, start it and stop it.

``configure`` loads the tree and sets its actions up, ``activate`` ticks it, ``deactivate`` halts it, and
``cleanup`` shuts it down. When the tree ends by itself, the node deactivates itself; after an error of an
action, it goes through error processing and is unconfigured again.
"""

from collections.abc import Callable
from typing import Any

import tree_gardener.ros_wheels  # noqa: F401 - refuses two ROS before rclpy is loaded

from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from rclpy.lifecycle.node import LifecycleNodeMixin

from tree_gardener.errors import CallbackError, LoadError, TickError, in_full
from tree_gardener.ros import RosRunner
from tree_gardener.ros_entities import OpenedSince
from tree_gardener.ros_node import ActionNode, MainThreadGroup
from tree_gardener.ros_spinning import LAST_ZEROS
from tree_gardener.status import Status
from tree_gardener.tree import Tree

RCLError = rclpy_implementation.RCLError
_OK = TransitionCallbackReturn.SUCCESS
_REFUSED = TransitionCallbackReturn.FAILURE
_ERROR = TransitionCallbackReturn.ERROR


class LifecycleActionNode(LifecycleNodeMixin, ActionNode):
    """The node of a tree, with the services of the life cycle. `manage` says what its states mean."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        # Ticks are in this group too, so that no transition happens within a tick.
        self.group = MainThreadGroup()
        self._life: TreeLife | None = None
        ActionNode.__init__(self, *arguments, **options)
        LifecycleNodeMixin.__init__(self, callback_group=self.group)
        self._change = self._service_change_state.callback
        self._service_change_state.callback = self._change_if_it_fits

    def manage(self, life: "TreeLife") -> None:
        """Gives the node its tree."""
        self._life = life

    def _change_if_it_fits(self, request: Any, response: Any) -> Any:
        """Answers a request that does not fit the state with false, as rclcpp does; rclpy raises."""
        try:
            return self._change(request, response)
        except RCLError:
            wanted = request.transition.label or f"the transition {request.transition.id}"
            state = self._state_machine.current_state[1]
            self.get_logger().warning(f"{wanted} is refused: the node is {state}")
            response.success = False
            return response

    def on_configure(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Loads the tree and sets it up; the node stays unconfigured if that fails."""
        return _REFUSED if self._life is None else self._life.configure()

    def on_activate(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Ticks from now on."""
        return _REFUSED if self._life is None else self._life.activate()

    def on_deactivate(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Halts the tree."""
        return _OK if self._life is None else self._life.deactivate()

    def on_cleanup(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Shuts the tree down and closes its ROS entities."""
        return _OK if self._life is None else self._life.cleanup()

    def on_shutdown(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Shuts the tree down, in whatever state it is."""
        return _OK if self._life is None else self._life.cleanup()

    def on_error(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Shuts the tree down, so that it can be configured again."""
        if self._life is not None:
            self._life.cleanup()
        return _OK


class TreeLife:
    """The tree of a managed node.

    Args:
        node: the node.
        load: builds the tree.
        more: arguments of `RosRunner`, such as ``tick_hz``.
    """

    def __init__(self, node: LifecycleActionNode, load: Callable[[], Tree], **more: Any) -> None:
        self._node = node
        self._log = node.get_logger()
        self._load = load
        self._more = more
        self._opened: OpenedSince | None = None
        self._tree: Tree | None = None
        self._runner: RosRunner | None = None
        self._is_over = self._is_broken = False

    def step(self) -> None:
        """Deactivates the node if its tree ended; called between the callbacks of the executor."""
        if self._is_over:
            self._is_over = False
            self._node.trigger_deactivate()
        if self._is_broken:
            self._is_broken = False
            self._node.trigger_cleanup()

    def fail(self, error: BaseException) -> bool:
        """Handles an exception outside of a tick: ends the run, or gives up the tree that is configured.

        Returns whether there is a tree.
        """
        if self._runner is not None:
            self._runner.fail(error)
        elif self._tree is not None:
            self._log.error(in_full(CallbackError.of(error)))
            self._is_broken = True
        return self._tree is not None

    def end(self, await_answers: Callable[[], None]) -> None:
        """Halts the tree and shuts it down, at the end of the program.

        Args:
            await_answers: waits for the servers whose goals the tree cancelled.
        """
        if self._runner is not None:
            self._runner.stop()
            await_answers()
            self._node.commanded.stop(LAST_ZEROS)
        self.cleanup()

    def configure(self) -> TransitionCallbackReturn:
        """Loads the tree and calls the ``setup`` of its actions."""
        self._opened = OpenedSince(self._node)
        try:
            tree = self._load()
            tree.setup(node=self._node)
        except OSError as error:
            self._log.error(f"{error.filename} cannot be read: {error.strerror}")
        except LoadError as error:
            for problem in error.diagnostics:
                self._log.error(str(problem))
        except TickError as error:
            self._log.error(in_full(error))
        else:
            self._tree = tree
            return _OK
        self._opened.close()
        return _REFUSED

    def activate(self) -> TransitionCallbackReturn:
        """Begins to tick."""
        if self._tree is None:
            return _REFUSED
        self._runner = RosRunner(
            self._tree,
            self._node,
            finished=self._finish,
            callback_group=self._node.group,
            is_set_up=True,
            **self._more,
        )
        return _OK

    def deactivate(self) -> TransitionCallbackReturn:
        """Halts the tree; an error while it ran or halts is an error of the transition."""
        runner, self._runner = self._runner, None
        self._is_over = False
        if runner is None:
            return _OK
        runner.stop()
        self._node.commanded.end()
        return _OK if runner.runner.error is None else _ERROR

    def cleanup(self) -> TransitionCallbackReturn:
        """Shuts the tree down; an action that raises then is reported and does not keep it."""
        self.deactivate()
        self._is_broken = False
        tree, self._tree = self._tree, None
        if tree is not None:
            try:
                tree.shutdown()
            except TickError as error:
                self._log.error(in_full(error))
        if self._opened is not None:
            self._opened.close()
            self._opened = None
        return _OK

    def _finish(self, status: Status) -> None:
        self._log.info(f"the tree ended with {status.name}")
        self._is_over = True
