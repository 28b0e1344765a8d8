"""The tables of Nav2's nodes, one for each ROS distribution."""

from __future__ import annotations

import json
import re

import pytest

from translator.nav2.distributions import DISTRIBUTIONS
from translator.nav2.sources import TYPES
from translator.nav2.tables import place_of, table

COUNTS = {"humble": 51, "jazzy": 65, "kilted": 70, "lyrical": 81}
CPP = re.compile(r"(?:vector<[\w:]+>|[\w:]+::[\w:]+|nav2_msgs::msg::\w+)")


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_a_table_says_where_it_is_from_and_has_each_node_and_port_once(name) -> None:
    document = json.loads(place_of(name).read_text())
    assert document["branch"] == name
    assert re.fullmatch("[0-9a-f]{40}", document["commit"])
    assert re.fullmatch("[0-9a-f]{64}", document["sha256"])
    types = [node["type"] for node in document["nodes"]]
    assert len(types) == len(set(types)) == len(table(name)) == COUNTS[name]
    for node in document["nodes"]:
        assert node["kind"] in {"action", "condition", "control", "decorator"}
        ports = [port["name"] for port in node["ports"]]
        assert len(ports) == len(set(ports))
        for port in node["ports"]:
            assert port["direction"] in {"input", "output", "inout"}
            assert port["type"] in TYPES or CPP.fullmatch(port["type"]), (node["type"], port)


def test_what_a_file_leaves_out_is_that_of_the_node() -> None:
    ports = {port["name"]: port for port in table("kilted")["IsPathValid"]["ports"]}
    assert (ports["max_cost"]["type"], ports["max_cost"]["default"]) == ("unsigned int", "253")
    assert "is_recovery" in {port["name"] for port in table("humble")["Spin"]["ports"]}
    assert "input_path" in {port["name"] for port in table("humble")["TruncatePathLocal"]["ports"]}
