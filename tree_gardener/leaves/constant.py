from tree_gardener.node import SyncLeaf
from tree_gardener.status import FAILURE, SUCCESS, Status


class AlwaysSuccess(SyncLeaf):
    """Always succeeds, within one tick."""

    __slots__ = ()

    def run(self) -> Status:
        return SUCCESS


class AlwaysFailure(SyncLeaf):
    """Always fails, within one tick."""

    __slots__ = ()

    def run(self) -> Status:
        return FAILURE
