#!/usr/bin/env bash
# Guess: an address in package.xml is free text, or a wrong one is an error of `colcon list`.
# Seen: catkin_pkg 1.1.1 has a pattern for it that refuses valid addresses (an apostrophe, a host without a
# dot). colcon-ros 0.5.0 then passes the package over without a word, and colcon-python-setup-py takes it:
# `colcon list` says (python) instead of (ros.ament_python), with exit status 0. Such a package builds, but
# its dependencies in package.xml do not count and its order in the workspace is wrong.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check setuptools==79.0.1 \
  colcon-core==0.21.3 colcon-ros==0.5.0 colcon-python-setup-py==0.2.9 catkin_pkg==1.1.1 \
  colcon-package-information==0.4.1
mkdir -p work/src/robot/robot work/src/robot/resource
touch work/src/robot/robot/__init__.py work/src/robot/resource/robot
cat > work/src/robot/setup.py <<'PYTHON'
from setuptools import setup

setup(name="robot", version="0.1.0", packages=["robot"])
PYTHON
type_with() {
  cat > work/src/robot/package.xml <<XML
<package format="3">
  <name>robot</name><version>0.1.0</version><description>A robot.</description>
  <maintainer email="$1">Somebody</maintainer><license>MIT</license>
  <export><build_type>ament_python</build_type></export>
</package>
XML
  (cd work && ../env/bin/colcon --log-base /dev/null list | sed 's/.*(\(.*\))/\1/')
}
expect() {
  found=$(type_with "$1")
  echo "$1: $found"
  [ "$found" = "$2" ]
}
expect "somebody@example.org" ros.ament_python
expect "some.body+robot@example.museum" ros.ament_python
expect "o'body@example.org" python
expect "somebody@localhost" python
