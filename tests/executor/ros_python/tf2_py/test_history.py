"""The poses of one frame over time."""

import pytest


def test_samples_are_interpolated_within_the_history() -> None:
    from tf2_py.errors import ExtrapolationException
    from tf2_py.history import History, Sample
    from tf2_py.motion import Motion

    history = History(100)
    for stamp in (10, 20, 200):
        assert history.add(Sample(stamp, "map", Motion((float(stamp), 0.0, 0.0))))
    assert len(history) == 1, "old ones are removed"
    assert not history.add(Sample(200, "map", Motion()))
    assert history.add(Sample(150, "map", Motion((150.0, 0.0, 0.0))))
    assert history.at(175).motion.translation[0] == pytest.approx(175)
    assert history.at(0).stamp_ns == 200
    with pytest.raises(ExtrapolationException):
        history.at(300)
