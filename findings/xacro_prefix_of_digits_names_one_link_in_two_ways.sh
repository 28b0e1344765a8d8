#!/usr/bin/env bash
# Guess: a text that goes into xacro as an argument is the same text wherever it comes out.
# Seen with xacro 2.1.1: the argument 007 is "007" by $(arg robot), but 7 by a property or a macro's parameter that
# was set to it: what reads as a number of Python becomes one. 1e5 becomes 100000.0, and -0 becomes 0; 0x10, 1_000
# and 007_ stay. So one document can name what was meant as one link in two ways.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check xacro==2.1.1
cat > robot.xacro <<'XACRO'
<robot name="fleet" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="robot" default="a"/>
  <xacro:property name="robot" value="$(arg robot)"/>
  <xacro:macro name="arm" params="robot">
    <link name="${robot}arm"/>
  </xacro:macro>
  <link name="$(arg robot)base"/>
  <link name="${robot}wheel"/>
  <xacro:arm robot="$(arg robot)"/>
</robot>
XACRO
env/bin/python - <<'PYTHON'
import subprocess

from xml.etree import ElementTree

SEEN = {
    "a": ("abase", "awheel", "aarm"),
    "007": ("007base", "7wheel", "7arm"),
    "1e5": ("1e5base", "100000.0wheel", "100000.0arm"),
    "-0": ("-0base", "0wheel", "0arm"),
    "0x10": ("0x10base", "0x10wheel", "0x10arm"),
    "1_000": ("1_000base", "1_000wheel", "1_000arm"),
    "007_": ("007_base", "007_wheel", "007_arm"),
}
for argument, names in SEEN.items():
    text = subprocess.run(
        ["env/bin/xacro", "robot.xacro", f"robot:={argument}"], check=True, capture_output=True
    ).stdout
    found = tuple(link.get("name") for link in ElementTree.fromstring(text).iter("link"))
    print(argument, found)
    assert found == names, found
PYTHON
