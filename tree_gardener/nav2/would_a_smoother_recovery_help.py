"""WouldASmootherRecoveryHelp of Nav2."""

from tree_gardener.nav2.are_error_codes_present import AreErrorCodesPresent
from tree_gardener.ports import Port


class WouldASmootherRecoveryHelp(AreErrorCodesPresent):
    """Succeeds if a recovery may help the smoother, by its last error.

    The error must be one of: unknown, timeout, path in collision, smoothing failed. The codes are fixed;
    those of the port are not read, as in Nav2.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "error_code": Port(int, description="The error code."),
        "error_codes_to_check": Port(list[int], description="Not read: the codes are fixed."),
    }

    codes = frozenset((500, 502, 503, 504))
