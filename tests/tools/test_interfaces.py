"""The table of ROS interfaces in the translator."""

from tests.tools.interfaces import text
from translator.ros_interfaces import TABLE


def test_the_table_names_what_is_installed() -> None:
    assert TABLE.read_text(encoding="utf-8") == text(), "python -m tests.tools.interfaces"
