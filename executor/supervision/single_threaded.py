"""The environment of processes whose forks are runs."""

from __future__ import annotations

from typing import Final

SINGLE_THREADED: Final = {
    "PYTHONHASHSEED": "0",
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "LP_NUM_THREADS": "0",
    "MESA_SHADER_CACHE_DISABLE": "true",
}
"""Variables that keep libraries from starting threads, which a fork would lose, and sets in one order."""
