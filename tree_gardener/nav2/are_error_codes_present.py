"""AreErrorCodesPresent of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.reading import input_or
from tree_gardener.ports import Port


class AreErrorCodesPresent(Behaviour):
    """Succeeds if the error code is one of those to check.

    The list is read once, before the first tick. If the code cannot be read, the last code counts; at first
    it is 0. Rule: Nav2's plugins/condition/are_error_codes_present_condition.hpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "error_code": Port(int, description="The error code."),
        "error_codes_to_check": Port(list[int], description="The codes to look for, such as 104;105."),
    }

    codes: frozenset[int] = frozenset()

    def setup(self, **kwargs: Any) -> None:
        self.error_code = 0
        if not self.codes:
            self.codes = frozenset(input_or(self, "error_codes_to_check", ()))

    def update(self) -> Status:
        self.error_code = input_or(self, "error_code", self.error_code)
        return Status.SUCCESS if self.error_code in self.codes else Status.FAILURE
