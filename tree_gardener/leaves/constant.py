"""AlwaysSuccess and AlwaysFailure."""

from tree_gardener.node import SyncLeaf
from tree_gardener.status import FAILURE, SUCCESS, Status


class AlwaysSuccess(SyncLeaf):
    """Succeeds at once."""

    __slots__ = ()

    def run(self) -> Status:
        return SUCCESS


class AlwaysFailure(SyncLeaf):
    """Fails at once."""

    __slots__ = ()

    def run(self) -> Status:
        return FAILURE
