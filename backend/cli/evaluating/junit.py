"""The results of an evaluation as JUnit's XML: one case a seed, and one a gate."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

from backend.cli.behaviour_tests import xml_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from executor.evaluation.gates import Verdict
    from executor.evaluation.summary import Summary


def junit_xml(name: str, summary: Summary, verdicts: Sequence[Verdict]) -> bytes:
    """Returns the results; a run that failed for reasons outside of the project counts as skipped."""
    counts = summary.counts
    failures = counts.get("failure", 0) + sum(not verdict.passes for verdict in verdicts)
    errors = sum(counts.get(outcome, 0) for outcome in ("error", "crashed", "timeout"))
    numbers: Any = {
        "tests": str(len(summary.outcomes) + len(verdicts)),
        "failures": str(failures),
        "errors": str(errors),
        "skipped": str(len(summary.outcomes) - summary.counted),
    }
    root = ET.Element("testsuites")
    suite = ET.SubElement(root, "testsuite", name=xml_text(name), **numbers)
    for outcome in summary.outcomes:
        case = ET.SubElement(suite, "testcase", name=f"seed {outcome.seed}", classname=xml_text(name))
        if not outcome.is_counted:
            ET.SubElement(case, "skipped", message=xml_text(f"{outcome.outcome}: {outcome.why}"))
        elif outcome.outcome == "failure":
            ET.SubElement(case, "failure", message=xml_text(outcome.why))
        elif not outcome.is_success:
            ET.SubElement(case, "error", message=xml_text(outcome.why), type=outcome.outcome)
    for verdict in verdicts:
        case = ET.SubElement(suite, "testcase", name=xml_text(verdict.gate.text), classname=xml_text(name))
        if not verdict.passes:
            ET.SubElement(case, "failure", message=xml_text(verdict.why))
    written: bytes = ET.tostring(root, encoding="utf-8", xml_declaration=True)
    return written
