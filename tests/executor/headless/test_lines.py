"""Lines of runs without a browser."""

from __future__ import annotations

from executor.headless.lines import mismatch_line

FILES = {
    "actions/Look.py": b"import rclpy\n\nTOPIC = 'scan'\n",
    "actions/Move.py": b"TOPIC = '/scan'\n",
    "notes.md": b"'/odom'",
}


def test_a_mismatch_is_shown_at_the_line_that_names_the_topic():
    assert mismatch_line("/scan", "No.", "Do.", FILES) == "actions/Look.py:3:1: /scan: No. Do."
    assert mismatch_line("/odom", "No.", "Do.", FILES) == "/odom: No. Do."
