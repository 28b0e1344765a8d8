import warnings
from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from tests.domains import own_domain_id

if TYPE_CHECKING:
    from rclpy.context import Context

DOMAIN_ID = own_domain_id()

with warnings.catch_warnings():
    # rclpy's parser uses a module that Python 3.11 deprecates; the first node loads it.
    warnings.simplefilter("ignore", DeprecationWarning)
    import lark  # noqa: F401


@pytest.fixture
def context() -> Iterator["Context"]:
    """Yields an rclpy context of its own."""
    import rclpy
    from rclpy.context import Context

    made = Context()
    rclpy.init(context=made, domain_id=DOMAIN_ID)
    yield made
    made.try_shutdown()
