"""Packed poses are restored within the precision of the format."""

import numpy as np
import pytest

from executor.stream.pose_codec import POSE_BYTES, pack, unpack


def test_poses_come_back() -> None:
    random = np.random.default_rng(5)
    poses = random.normal(size=(2000, 7)).astype(np.float32)
    poses[:, :3] *= 40
    poses[:, 3:] /= np.linalg.norm(poses[:, 3:], axis=1, keepdims=True)
    packed = pack(poses)
    assert len(packed) == len(poses) * POSE_BYTES
    back = np.array([unpack(packed[at : at + POSE_BYTES]) for at in range(0, len(packed), POSE_BYTES)])
    assert np.abs(back[:, :3] - poses[:, :3]).max() < 6e-5
    # q and -q are the same rotation.
    same = np.sign((back[:, 3:] * poses[:, 3:]).sum(axis=1, keepdims=True))
    assert np.abs(back[:, 3:] * same - poses[:, 3:]).max() < 5e-5
    assert np.linalg.norm(back[:, 3:], axis=1) == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("part", range(4))
def test_each_part_may_be_the_largest(part: int) -> None:
    for sign in (1.0, -1.0):
        pose = np.zeros((1, 7), np.float32)
        pose[0, 3 + part] = sign
        back = unpack(pack(pose))
        assert back == pytest.approx([0, 0, 0, *(float(i == part) for i in range(4))])


def test_the_bytes_are_those_that_the_page_of_the_protocol_names() -> None:
    pose = np.array([[1.0, -0.0001, 2.5, 0.0, 0.0, 0.6, 0.8]], np.float32)
    packed = pack(pose)
    assert packed[:9] == bytes([0x10, 0x27, 0, 0xFF, 0xFF, 0xFF, 0xA8, 0x61, 0])
    assert packed[9] == 3
    assert np.frombuffer(packed[10:], "<i2").tolist() == [0, 0, round(0.6 * 32767 * 2**0.5)]


def test_what_is_far_beyond_is_kept_at_the_rim() -> None:
    pose = np.array([[1e6, -1e6, 838.8, 0, 0, 0, 1]], np.float32)
    assert unpack(pack(pose))[:3] == pytest.approx([838.8607, -838.8607, 838.8])


def test_nothing_is_nothing_and_nonsense_is_refused() -> None:
    assert pack(np.empty((0, 7), np.float32)) == b""
    with pytest.raises(ValueError, match="16 bytes"):
        unpack(b"\0" * 15)
    with pytest.raises(ValueError, match="no part 4"):
        unpack(b"\0" * 9 + b"\4" + b"\0" * 6)
