"""The environment of a process whose forks are runs."""

from __future__ import annotations

from typing import Final

SINGLE: Final = {
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "LP_NUM_THREADS": "0",
}
"""Variables that keep libraries from starting threads, which a fork would lose."""
