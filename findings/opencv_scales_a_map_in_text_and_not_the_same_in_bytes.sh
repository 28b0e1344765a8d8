#!/usr/bin/env bash
# Guess: a PGM whose header says that 100 is white is the same picture as text (P2) and as bytes (P5), in any reader.
# Seen with opencv-python-headless 4.14.0.94 and pillow 13.0.0: OpenCV scales the text to 255 and leaves the bytes
# as they are, so white is 255 in one and 100 in the other; with 1000 as white it scales neither, and as a picture of
# 8 bits white is 3. Pillow scales all of them, as ImageMagick does, with which nav2_map_server reads.
# With occupied_thresh 0.65 of an occupancy map, the free cells of the last one are walls.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check \
  opencv-python-headless==4.14.0.94 pillow==13.0.0 numpy
env/bin/python - <<'PYTHON'
from pathlib import Path

import cv2
import numpy as np
from PIL import Image

SEEN = {
    ("P2", 100): ([0, 127, 255], [0, 128, 255]),
    ("P5", 100): ([0, 50, 100], [0, 128, 255]),
    ("P2", 255): ([0, 127, 255], [0, 127, 255]),
    ("P5", 255): ([0, 127, 255], [0, 127, 255]),
    ("P2", 1000): ([0, 500, 1000], [0, 32768, 65535]),
    ("P5", 1000): ([0, 500, 1000], [0, 32768, 65535]),
}
for (kind, white), (opencv, pillow) in SEEN.items():
    values = [0, white // 2, white]
    if kind == "P2":
        cells = " ".join(map(str, values)).encode() + b"\n"
    else:
        cells = b"".join(value.to_bytes(1 if white < 256 else 2, "big") for value in values)
    Path("map.pgm").write_bytes(f"{kind}\n3 1\n{white}\n".encode() + cells)
    found = (
        cv2.imread("map.pgm", cv2.IMREAD_UNCHANGED)[0].tolist(),
        np.asarray(Image.open("map.pgm"))[0].tolist(),
    )
    print(kind, white, *found)
    assert found == (opencv, pillow), found
assert cv2.imread("map.pgm", cv2.IMREAD_GRAYSCALE)[0].tolist() == [0, 1, 3]
PYTHON
