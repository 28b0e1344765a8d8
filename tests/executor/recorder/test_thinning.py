"""Topics that send too much."""

from __future__ import annotations

from executor.recorder.thinning import Thinner


def test_a_topic_over_its_bytes_is_thinned_and_said_once():
    thinner = Thinner()
    verdicts = [thinner.take("/cloud", 0.1, 90_000) for _ in range(4)]
    assert [verdict.is_kept for verdict in verdicts] == [True, True, False, False]
    assert [bool(verdict.note) for verdict in verdicts] == [False, False, True, False]
    assert "/cloud sends more than 200 KB/s" in verdicts[2].note
    assert thinner.take("/scan", 0.1, 90_000).is_kept
    assert thinner.take("/cloud", 1.1, 90_000).is_kept


def test_one_message_a_second_is_kept_however_large():
    thinner = Thinner()
    assert [thinner.take("/map", t, 1_000_000).is_kept for t in (0.0, 0.5, 1.0)] == [True, False, True]
