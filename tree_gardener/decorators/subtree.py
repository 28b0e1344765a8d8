from tree_gardener.node import Decorator, Kind
from tree_gardener.status import IDLE, RUNNING, SKIPPED, Status


class SubTree(Decorator):
    """Ticks another tree, with a blackboard of its own.

    Its attributes connect names: ``inner="{outer}"`` gives one entry two names, for reading and writing.
    ``{=}`` means the same name in both trees, ``{@name}`` an entry of the root; any other text is a constant.
    With ``_autoremap`` all names that are not found in the SubTree are those of the caller, except names that
    begin with ``_``. The pre- and post-conditions of the node are evaluated in the caller's blackboard.
    """

    __slots__ = ()
    KIND = Kind.SUBTREE
    MARKS_RUNNING = (IDLE,)

    @property
    def scope_path(self) -> str:
        """The last part of the path of the nodes inside: the name, or ``ID::number`` if it has none."""
        return self.name if "name" in self.element.attributes else self.local_path

    @property
    def scope(self) -> str:
        """The path of the nodes inside, without their own names."""
        prefix = self.instance.path()
        return f"{prefix}/{self.scope_path}" if prefix else self.scope_path

    def execute(self) -> Status:
        if self.status is not RUNNING:
            quick = self.quick
            if quick is not None:
                return quick()  # type: ignore[no-any-return]
            if self.status is IDLE:
                self.start()
        tick = self.tick_child
        return self.go_on(0, tick())

    def go_on(self, _index: int, status: Status) -> Status:
        if status is RUNNING:
            if self.status is not RUNNING:
                self.start()
            return RUNNING
        return self.skipped() if status is SKIPPED else self.finish(status)
