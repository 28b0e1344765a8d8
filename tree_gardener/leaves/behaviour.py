"""Leaves that tick py_trees behaviours.

By default a behaviour is a StatefulAction. Its class attribute ``NODE_KIND`` makes it something else.
"""

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Final

from py_trees.behaviour import Behaviour
from py_trees.common import Status as PyTreesStatus

from tree_gardener.errors import TickError, class_place, describe, warn_of
from tree_gardener.node import Kind, Leaf
from tree_gardener.status import FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, Status, to_py_trees

PY_RUNNING, PY_SUCCESS = PyTreesStatus.RUNNING, PyTreesStatus.SUCCESS
PY_FAILURE, PY_INVALID = PyTreesStatus.FAILURE, PyTreesStatus.INVALID
_INITIALISE, _TERMINATE = Behaviour.initialise, Behaviour.terminate


class BehaviourLeaf(Leaf):
    """Ticks a py_trees behaviour.

    `initialise` and `terminate` are None if the class does not override those of py_trees, which do nothing.
    An exception in `terminate` is reported and changes nothing.
    """

    __slots__ = ("initialise", "instance_behaviour", "terminate", "update")

    ALLOWS_RUNNING: ClassVar[bool] = True

    instance_behaviour: Any

    def bind(self, behaviour: Any) -> None:
        """Sets the behaviour that this node ticks."""
        self.instance_behaviour = behaviour
        self.update: Callable[[], Any] = behaviour.update
        initialise, terminate = behaviour.initialise, behaviour.terminate
        is_plain = getattr(initialise, "__func__", None) is _INITIALISE
        self.initialise: Callable[[], Any] | None = None if is_plain else initialise
        is_plain = getattr(terminate, "__func__", None) is _TERMINATE
        self.terminate: Callable[[Any], Any] | None = None if is_plain else self.guarded(terminate)

    def guarded(self, terminate: Callable[[Any], Any]) -> Callable[[Any], None]:
        """Returns a function that calls `terminate` and reports what it raises."""

        def call(status: Any) -> None:
            try:
                terminate(status)
            except (Exception, SystemExit) as error:
                warn_of(self, "terminate", error)

        return call

    def replace_update(self, update: Callable[[], Any]) -> None:
        """Calls another function in place of `update` from the next tick on."""
        self.update = update
        self.tree.forget_code(self)

    @property
    def behaviour(self) -> Any:
        return self.instance_behaviour

    def halt(self) -> None:
        if self.status is RUNNING:
            if self.terminate is not None:
                self.terminate(PY_INVALID)
            self.instance_behaviour.status = PY_INVALID
        self.status = IDLE

    def end(self, result: Status) -> Status:
        """Ends the activation, since the behaviour succeeded or failed."""
        py_status = PY_SUCCESS if result is SUCCESS else PY_FAILURE
        if self.terminate is not None:
            self.terminate(py_status)
        self.instance_behaviour.status = py_status
        return self.complete(result)

    def end_broken(self) -> None:
        """Ends an activation whose first tick raised; BehaviorTree.CPP does not halt such a node."""
        if self.terminate is not None:
            self.terminate(PY_INVALID)
        self.instance_behaviour.status = PY_INVALID

    def translate(self, returned: Any) -> Status:
        """Converts the value that `update()` returned to a status of the engine, in the rare cases."""
        if returned is PY_FAILURE:
            return FAILURE
        if returned is PY_SUCCESS:
            return SUCCESS
        if returned is PY_RUNNING:
            return RUNNING
        if isinstance(returned, Status) and returned is not IDLE:
            return returned
        if returned is PY_INVALID:  # py_trees' composites treat it as a failure
            self.tree.warn(self, f"{self.type}.update() returned Status.INVALID, which counts as FAILURE")
            return FAILURE
        name = self.type
        if returned is None:
            message = f"{name}.update() returned nothing; it must return a py_trees.common.Status"
        else:
            message = f"{name}.update() returned {returned!r}, which is no result of a tick"
        raise TickError(self, message, place=class_place(self))

    def failed(self, error: Exception | SystemExit) -> Status:
        """Handles an exception. The tick ends with an error, or the node fails, as the tree is configured.

        A node that fails is terminated. The end of the run terminates the others: those that are RUNNING when
        it halts the tree, and one whose first tick raised by `end_broken`.
        """
        located = error if isinstance(error, TickError) else TickError(self, describe(error), error)
        if self.tree.on_error is None:
            located.has_begun = self.status is not RUNNING
            raise located from error
        self.tree.on_error(located)
        if self.terminate is not None:
            self.terminate(PY_FAILURE)
        self.instance_behaviour.status = PY_FAILURE
        return self.complete(FAILURE)


class StatefulLeaf(BehaviourLeaf):
    """A StatefulAction: ``initialise()`` and ``update()`` to start, ``update()`` while RUNNING.

    ``terminate(status)`` is called after SUCCESS or FAILURE, ``terminate(INVALID)`` when it is halted. A leaf
    that has kept SUCCESS or FAILURE, because its parent did not reset it, returns it again without any call.
    """

    __slots__ = ()

    def execute(self) -> Status:
        # `update = self.update; update()` takes half the time of `self.update()`, whose lookup Python
        # does not specialise for attributes in slots.
        before, update = self.status, self.update
        try:
            if before is not RUNNING:
                if before is not IDLE:
                    return self.complete(before)  # reported: its parent may reset it in this tick
                if self.initialise is not None:
                    self.initialise()
            returned = update()
            if returned is PY_SUCCESS:
                if self.terminate is not None:
                    self.terminate(PY_SUCCESS)
                self.instance_behaviour.status = PY_SUCCESS
                self.status = SUCCESS
                if self.journal is not None:
                    self.journal.results.append(self.marks[0])
                return SUCCESS
            if returned is PY_RUNNING:
                if before is not RUNNING:
                    self.instance_behaviour.status = PY_RUNNING
                    self.start()
                return RUNNING
        except (Exception, SystemExit) as error:
            return self.failed(error)
        return self.conclude(returned, before)

    def conclude(self, returned: Any, before: Status) -> Status:
        """Ends a tick with the value that `update` returned; `before` is the status before the tick."""
        try:
            result = self.translate(returned)
            if result is RUNNING:
                if before is not RUNNING:
                    self.instance_behaviour.status = PY_RUNNING
                    self.start()
                return RUNNING
            return self.skipped() if result is SKIPPED else self.end(result)
        except (Exception, SystemExit) as error:
            return self.failed(error)


class ImmediateLeaf(BehaviourLeaf):
    """A SyncAction: each tick is a whole activation, from any status; RUNNING is an error."""

    __slots__ = ()
    ALLOWS_RUNNING = False

    def execute(self) -> Status:
        before = self.status
        try:
            if self.initialise is not None and before is not RUNNING:
                self.initialise()
            returned = self.update()
        except (Exception, SystemExit) as error:
            return self.failed(error)
        return self.conclude(returned, before)

    def conclude(self, returned: Any, before: Status) -> Status:
        """Ends a tick with the value that `update` returned; `before` is the status before the tick."""
        try:
            result = SUCCESS if returned is PY_SUCCESS else self.translate(returned)
            if result is SUCCESS or result is FAILURE:
                return self.end(result)
        except (Exception, SystemExit) as error:
            return self.failed(error)
        if result is SKIPPED:
            return self.skipped()
        if before is not RUNNING:
            self.instance_behaviour.status = to_py_trees(RUNNING)
            self.start()
        if not self.ALLOWS_RUNNING:
            hint = "leave out NODE_KIND to let it run over several ticks"
            message = f"a SyncAction must not return RUNNING ({hint})"
            return self.failed(TickError(self, message, place=class_place(self)))
        return RUNNING


class ConditionLeaf(ImmediateLeaf):
    """A Condition: it is evaluated at every tick, from any status."""

    __slots__ = ()
    KIND = Kind.CONDITION
    ALLOWS_RUNNING = True


LEAF_KINDS: Final[Mapping[str, type[BehaviourLeaf]]] = {
    "Action": StatefulLeaf,
    "StatefulAction": StatefulLeaf,
    "SyncAction": ImmediateLeaf,
    "Condition": ConditionLeaf,
}
