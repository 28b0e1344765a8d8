"""The definitions of the packages of messages that set-up builds."""

from __future__ import annotations

import pytest

from executor.ros.interface_definitions import PACKAGES, definitions_of


@pytest.mark.parametrize("package", PACKAGES)
def test_a_package_has_definitions_of_known_kinds(package: str) -> None:
    found = list(definitions_of(package))
    assert found
    assert all(str(path).endswith((".msg", ".srv", ".action")) for path in found)
