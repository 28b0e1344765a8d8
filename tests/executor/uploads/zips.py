"""Zips of robots and worlds that tests upload."""

from __future__ import annotations

import io
import struct
import zipfile
from typing import TYPE_CHECKING

from tests.executor.robots.importing.carts import BODY, CASTOR, PAIR, robot

if TYPE_CHECKING:
    from collections.abc import Mapping

CART = robot(BODY, PAIR, CASTOR.format(x=0.1))
CORNERS = b"vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0"
MESH = b"solid a\nfacet normal 0 0 1\nouter loop\n" + CORNERS + b"\nendloop\nendfacet\nendsolid"
MACROS = CART.replace('name="cart"', 'name="cart" xmlns:xacro="http://x"', 1).replace(
    "</robot>",
    '<xacro:arg name="top" default="lid"/><link name="$(arg top)"><visual><geometry>'
    '<mesh filename="package://cart/meshes/lid.stl"/></geometry></visual></link>'
    '<joint name="t" type="fixed"><parent link="base_link"/><child link="$(arg top)"/></joint><extra/>'
    "</robot>",
)
PACKAGE = {
    "ws/cart/package.xml": b"<package><name>cart</name></package>",
    "ws/cart/urdf/cart.urdf.xacro": MACROS.encode(),
    "ws/cart/meshes/lid.stl": MESH,
}
YARD = b"""<sdf version="1.9"><world name="yard"><physics/>
<include><uri>model://crate</uri></include></world></sdf>"""
WORLD = {
    "shop/worlds/yard.sdf": YARD,
    "shop/models/crate/model.config": b"<model><name>crate</name><sdf>model.sdf</sdf></model>",
    "shop/models/crate/model.sdf": b"<sdf version='1.9'><model name='crate'><static>1</static><link name='l'>"
    b"<visual name='v'><geometry><mesh><uri>model://crate/a.stl</uri></mesh></geometry></visual></link></model></sdf>",
    "shop/models/crate/a.stl": MESH,
}
MAP = {
    "flat/map.yaml": b"image: flat.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n",
    "flat/flat.pgm": b"P5 2 1 255\n\x00\xfe",
}


def triangles(count: int) -> bytes:
    """Returns a binary STL of so many triangles, of 50 bytes each."""
    corners = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    return bytes(80) + struct.pack("<I", count) + corners * count


def zipped(files: Mapping[str, bytes], links: Mapping[str, str] | None = None) -> bytes:
    """Returns a zip of these files, and of links."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            archive.writestr(path, data)
        for path, to in (links or {}).items():
            entry = zipfile.ZipInfo(path)
            entry.external_attr = 0o120777 << 16
            archive.writestr(entry, to)
    return made.getvalue()
