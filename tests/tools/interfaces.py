"""Writes the table of ROS interfaces that sessions have: one interface on each line."""

from __future__ import annotations

import json

from translator.installed_interfaces import table
from translator.ros_interfaces import TABLE


def text() -> str:
    """Returns the table of the interfaces that are installed here, as JSON."""
    lines = (f"{json.dumps(name)}: {json.dumps(parts)}" for name, parts in table().items())
    return "{\n" + ",\n".join(lines) + "\n}\n"


if __name__ == "__main__":
    TABLE.write_text(text(), encoding="utf-8")
