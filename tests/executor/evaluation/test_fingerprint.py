"""The platform fingerprint."""

import sys

from executor.evaluation.fingerprint import differences, fingerprint


def test_a_fingerprint_is_the_same_twice_and_names_no_host():
    mine = fingerprint()
    sys.path.append("/nowhere/ray/thirdparty_files")
    try:
        assert fingerprint() == mine
    finally:
        sys.path.remove("/nowhere/ray/thirdparty_files")
    assert {"id", "processor", "drawing", "packages", "numpy", "pybullet"} <= mine.keys()
    assert differences(mine, mine) == []
    other = {**mine, "id": "x", "numpy": "0.1"}
    assert differences(mine, other) == [f"numpy: 0.1 then, {mine['numpy']} now"]
