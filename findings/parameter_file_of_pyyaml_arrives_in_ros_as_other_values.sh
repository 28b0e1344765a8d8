#!/usr/bin/env bash
# Guess: parameters that PyYAML or ruamel.yaml writes reach a ROS 2 node with the values that were written.
# Seen with rclpy 7.1.6 (rcl_yaml_param_parser 9.2.8), PyYAML 6.0.3 and ruamel.yaml 0.19.1: ROS decides the type of a
# plain scalar by rules of its own, wider than YAML 1.1 here and narrower there.
#   texts that both writers leave plain: "y" and "Y" arrive as True, "n" as False, "nan" and "inf" as numbers;
#   PyYAML's "1e3" arrives as 1000.0, ruamel's "on", "yes" as True;
#   read by hand from one file: 1e3 is a text in PyYAML and 1000.0 in ROS, 1:30 is 90 and "1:30", 0b11 is 3 and
#   "0b11", 1_000 is 1000 and "1_000", null is None and "null", a date is a date and a text, 2 ** 63 is an integer and
#   a double. Both read 012 as 10.
# So a parameter `axis: y` of a generated file is no text for the node that declared one.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check \
  ros-jazzy-rclpy==7.1.6 ros-jazzy-common-interfaces==5.3.6 \
  ros-rmw-fastrtps-cpp==8.4.3 numpy==2.4.6 pyyaml==6.0.3 ruamel.yaml==0.19.1
env/bin/python - <<'PYTHON'
import datetime
import io
import math
import os
from pathlib import Path

os.environ["ROS_DOMAIN_ID"] = "95"
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"

import rclpy
import ruamel.yaml
import yaml


def in_ros(text):
    """The values of parameters of a file, by name, as a node has them."""
    Path("parameters.yaml").write_text(text)
    context = rclpy.Context()
    rclpy.init(args=["--ros-args", "--params-file", "parameters.yaml"], context=context)
    node = rclpy.create_node("node", context=context, automatically_declare_parameters_from_overrides=True)
    values = {name: each.value for name, each in node.get_parameters_by_prefix("").items()}
    node.destroy_node()
    rclpy.shutdown(context=context)
    return values


def by_pyyaml(content):
    return yaml.safe_dump(content)


def by_ruamel(content):
    written = io.StringIO()
    ruamel.yaml.YAML().dump(content, written)
    return written.getvalue()


def same(one, other):
    both_nan = isinstance(one, float) and isinstance(other, float) and math.isnan(one) and math.isnan(other)
    return both_nan or (type(one) is type(other) and one == other)


NUMBERS = {"nan": math.nan, "inf": math.inf}
WRITTEN = {
    by_pyyaml: {"y": True, "Y": True, "n": False, "1e3": 1000.0, "on": "on", "yes": "yes", "null": "null"} | NUMBERS,
    by_ruamel: {"y": True, "Y": True, "n": False, "1e3": "1e3", "on": True, "yes": True, "null": "null"} | NUMBERS,
}
for writer, expected in WRITTEN.items():
    names = {f"p{number}": text for number, text in enumerate(expected)}
    found = in_ros(writer({"node": {"ros__parameters": names}}))
    for name, text in names.items():
        print(writer.__name__, repr(text), "arrives as", repr(found[name]))
        assert same(found[name], expected[text]), (writer.__name__, text)

READ = {
    "1e3": ("1e3", 1000.0),
    "1:30": (90, "1:30"),
    "0b11": (3, "0b11"),
    "1_000": (1000, "1_000"),
    "null": (None, "null"),
    "2001-01-01": (datetime.date(2001, 1, 1), "2001-01-01"),
    str(2**63): (2**63, float(2**63)),
    "012": (10, 10),
}
text = "node:\n  ros__parameters:\n" + "".join(f"    p{n}: {each}\n" for n, each in enumerate(READ))
theirs, ours = yaml.safe_load(text)["node"]["ros__parameters"], in_ros(text)
for number, (scalar, (python, ros)) in enumerate(READ.items()):
    name = f"p{number}"
    print(scalar, "is", repr(theirs[name]), "in PyYAML,", repr(ours[name]), "in ROS")
    assert same(theirs[name], python), scalar
    assert same(ours[name], ros), scalar
PYTHON
