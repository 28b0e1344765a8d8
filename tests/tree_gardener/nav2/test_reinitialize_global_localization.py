"""ReinitializeGlobalLocalization of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from std_srvs.srv import Empty

from tree_gardener import Status
from tree_gardener.nav2.reinitialize_global_localization import ReinitializeGlobalLocalization

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_the_service_is_called(ros: Graph) -> None:
    requests: list[object] = []

    def answer(request: object, response: object) -> object:
        requests.append(request)
        return response

    ros.other.create_service(Empty, "spread", answer)
    assert ReinitializeGlobalLocalization.SERVICE_TYPE == "std_srvs/srv/Empty"
    assert ros.run("<ReinitializeGlobalLocalization service_name='spread'/>") is Status.SUCCESS
    assert len(requests) == 1
