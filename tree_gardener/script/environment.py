"""The environment in which a script runs."""

from collections.abc import Mapping

from tree_gardener.blackboard import Blackboard


class Environment:
    """The environment of a script: a scope of the blackboard, the constants, and the uid that writes."""

    __slots__ = ("board", "enums", "writer")

    def __init__(self, board: Blackboard, enums: Mapping[str, int], writer: int = 0) -> None:
        self.board = board
        self.enums = enums
        self.writer = writer
