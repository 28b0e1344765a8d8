"""Small pictures of runs, from the bytes of an untrusted process."""

from __future__ import annotations

import struct
from xml.etree import ElementTree as ET

import numpy as np
import pytest
import simplejpeg

from backend.workers.thumbnails import thumbnail

SVG = "{http://www.w3.org/2000/svg}"
NOTHING: dict[str, list] = {"boxes": [], "trail": [], "rows": []}


def jpeg(height, width, color=(200, 30, 30)):
    return simplejpeg.encode_jpeg(np.full((height, width, 3), color, np.uint8), 90)


@pytest.mark.parametrize("size", [(480, 640), (200, 320), (10, 10), (1, 2000), (1080, 1920)])
def test_a_picture_is_made_small_and_keeps_its_colour(size):
    made = thumbnail(jpeg(*size), **NOTHING)
    assert made["type"] == "image/jpeg"
    pixels = simplejpeg.decode_jpeg(made["data"])
    assert pixels.shape[0] <= 200
    assert pixels.shape[1] <= 320
    assert np.abs(pixels.mean(axis=(0, 1)) - (200, 30, 30)).max() < 12


def test_a_picture_is_encoded_again():
    source = jpeg(20, 20)
    hidden = source[:2] + b"\xff\xfe" + struct.pack(">H", 2 + 8) + b"<script>" + source[2:]
    assert simplejpeg.decode_jpeg(hidden).shape == (20, 20, 3)
    assert b"<script>" not in thumbnail(hidden, **NOTHING)["data"]


def huge():
    """Claims 65,000 by 65,000 pixels."""
    data = bytearray(jpeg(16, 16))
    at = data.index(b"\xff\xc0") + 5
    data[at : at + 4] = struct.pack(">HH", 65000, 65000)
    return bytes(data)


@pytest.mark.parametrize("picture", [b"", b"\xff\xd8\xff" * 9, jpeg(64, 64)[:60], huge()])
def test_what_cannot_be_decoded_is_drawn_instead(picture):
    made = thumbnail(picture, [], [], [[0, 1], [1, 2]])
    assert made["type"] == "image/svg+xml"
    assert thumbnail(picture, **NOTHING) == {"type": "", "data": b""}


def test_the_world_is_drawn_with_the_way_of_the_robot():
    boxes = [[0.0, 0.0, 1.0, 0.5, 0.5, 0.0], [3.0, 3.0, 0.2, 0.2, 0.0, 1.0]]
    made = thumbnail(b"", boxes, [[-2.0, 0.0], [2.0, 1.0], [2.0, 2.0]], [])
    root = ET.fromstring(made["data"])  # noqa: S314 - ours
    assert len(root.findall(f"*/{SVG}rect")) == 1
    assert len(root.findall(f"*/{SVG}circle")) == 1
    line = root.find(f"{SVG}polyline").attrib["points"].split()
    points = [tuple(map(float, point.split(","))) for point in line]
    assert points[0][0] < points[1][0] == points[2][0]
    assert points[0][1] > points[1][1] > points[2][1]  # up is up
    assert all(0 <= x <= 320 and 0 <= y <= 200 for x, y in points)


def test_a_robot_that_stays_where_it_is_is_drawn_too():
    made = thumbnail(b"", [], [[5.0, 5.0]], [])
    assert b"160.0,100.0" in made["data"]


def test_a_tree_without_a_world_is_drawn_with_its_statuses():
    made = thumbnail(b"", [[0.0] * 6], [], [[0, 1], [1, 2], [40, 77]] * 20)
    bars = ET.fromstring(made["data"]).findall(f"{SVG}rect")  # noqa: S314 - ours
    assert 10 < len(bars) < 20
    assert bars[0].attrib["fill"] != bars[1].attrib["fill"]
