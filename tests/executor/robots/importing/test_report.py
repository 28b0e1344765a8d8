"""Places in the report of an import."""

from __future__ import annotations

from lxml import etree

from executor.robots.importing.report import Report
from executor.robots.sdf_model import LINE


def test_an_element_has_the_line_of_its_source() -> None:
    report = Report(lambda line: f"part.xacro:{line + 10}", "cart.sdf")
    root = etree.fromstring(f'<robot>\n<a/><b {LINE}="7"/></robot>')
    report.leave_out(root[0], "a is left out")
    report.leave_out(root[1], "b is left out")
    assert report.left_out == ["part.xacro:12: a is left out", "cart.sdf:7: b is left out"]
