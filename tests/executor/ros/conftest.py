import warnings
from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from rclpy.context import Context

DOMAIN_ID = 221  # sessions take theirs from below

with warnings.catch_warnings():
    # rclpy's parser takes a module that Python 3.11 calls deprecated; it is loaded with the first node.
    warnings.simplefilter("ignore", DeprecationWarning)
    import lark  # noqa: F401


@pytest.fixture
def context() -> Iterator["Context"]:
    """An rclpy context of its own."""
    import rclpy
    from rclpy.context import Context

    made = Context()
    rclpy.init(context=made, domain_id=DOMAIN_ID)
    yield made
    made.try_shutdown()
