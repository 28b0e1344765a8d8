"""WouldARouteRecoveryHelp of Nav2."""

from tree_gardener.nav2.are_error_codes_present import AreErrorCodesPresent
from tree_gardener.ports import Port


class WouldARouteRecoveryHelp(AreErrorCodesPresent):
    """Succeeds if a recovery may help the route server: the error is unknown, timeout, or no valid route.

    The codes are fixed; those of the port are not read, as in Nav2.
    Rule: Nav2's plugins/condition/would_a_route_recovery_help_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "error_code": Port(int, description="The error code."),
        "error_codes_to_check": Port(list[int], description="Not read: the codes are fixed."),
    }

    codes = frozenset((400, 404, 405))
