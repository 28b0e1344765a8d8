"""The environment of the pool's processes."""

from executor.evaluation.pool.environment import SINGLE


def test_libraries_start_no_threads():
    assert SINGLE["OPENBLAS_NUM_THREADS"] == "1"
    assert SINGLE["LP_NUM_THREADS"] == "0"
