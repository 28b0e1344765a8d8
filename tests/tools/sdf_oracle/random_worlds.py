"""Random SDF worlds of the subset that is read: the same for each number, everywhere."""

from __future__ import annotations

from random import Random
from typing import Final

COUNT: Final = 300
PART: Final = """<?xml version="1.0"?>
<sdf version="1.8"><model name="part"><pose>0.5 0 0 0 0 0.3</pose>
<frame name="foot"><pose>0.1 0.2 -0.5 0.1 0 0</pose></frame>
<link name="base"><pose>0 0 0.4 0 0.2 0</pose></link>
<link name="arm"><pose relative_to="base">0.3 0 0 0 0 1</pose></link>
<joint name="j" type="fixed"><pose>0 0 0.1 0 0 0</pose><parent>base</parent><child>arm</child></joint>
</model></sdf>
"""
"""The model `model://part`."""
CONFIG: Final = '<model><name>part</name><version>1.0</version><sdf version="1.8">model.sdf</sdf></model>'


def world_of(number: int) -> str:
    """Returns one of the worlds."""
    return _Writer(Random(number)).world()  # noqa: S311 - the same each time is the point


class _Writer:
    def __init__(self, random: Random) -> None:
        self.random = random
        self.version = random.choice(["1.6", "1.7", "1.8", "1.9", "1.9", "1.9"])
        self.is_old = self.version == "1.6"
        self.count = 0

    def world(self) -> str:
        names: list[str] = []
        body = []
        for _ in range(self.random.randint(1, 6)):
            kind = self.random.choice(["model", "model", "model", "frame", "light", "include"])
            if kind == "model":
                body.append(self.model(names, 0))
            elif kind == "light":
                direction = "<direction>0 0 -1</direction>"
                light = (
                    f"<light name='{self.name('l')}' type='directional'>{self.pose(names)}{direction}</light>"
                )
                body.append(light)
            elif kind == "frame" and not self.is_old:
                body.append(self.frame(names))
            elif kind == "include":
                body.append(self.include(names))
        inside = "\n".join(body)
        opening = f'<?xml version="1.0"?>\n<sdf version="{self.version}"><world name="w">'
        return f"{opening}\n{inside}\n</world></sdf>\n"

    def model(self, around: list[str], depth: int) -> str:
        name = self.name("m")
        pose = self.pose(around)
        inner: list[str] = []
        links: list[str] = []
        body = []
        for _ in range(self.random.randint(1, 3)):
            link = self.name("k")
            body.append(f"<link name='{link}'>{self.pose(inner)}</link>")
            inner.append(link)
            links.append(link)
        if len(links) > 1 and self.random.random() < 0.5:
            joint = self.name("j")
            ends = f"<parent>{links[0]}</parent><child>{links[1]}</child>"
            axis = "<axis><xyz>0 0 1</xyz></axis>"
            body.append(f"<joint name='{joint}' type='revolute'>{self.pose(links)}{ends}{axis}</joint>")
            if not self.is_old:
                inner.append(joint)
        if not self.is_old and self.random.random() < 0.5:
            body.append(self.frame(inner))
        if self.version in ("1.8", "1.9") and depth < 2 and self.random.random() < 0.4:
            body.append(self.model(inner, depth + 1))
        placed = ""
        if self.version in ("1.8", "1.9") and self.random.random() < 0.3:
            placed = f" placement_frame='{self.random.choice(inner)}'"
        if not self.is_old:
            around += [name, *([f"{name}::{links[-1]}"] if self.version in ("1.8", "1.9") else [])]
        return f"<model name='{name}'{placed}>{pose}{''.join(body)}</model>"

    def frame(self, around: list[str]) -> str:
        name = self.name("f")
        attached = (
            f" attached_to='{self.random.choice(around)}'" if around and self.random.random() < 0.5 else ""
        )
        made = f"<frame name='{name}'{attached}>{self.pose(around)}</frame>"
        around.append(name)
        return made

    def include(self, around: list[str]) -> str:
        name = self.name("i")
        pose = self.pose(around) if self.random.random() < 0.7 else ""
        placed = ""
        if pose and self.version in ("1.8", "1.9") and self.random.random() < 0.5:
            placed = f"<placement_frame>{self.random.choice(['foot', 'arm', 'j'])}</placement_frame>"
        return f"<include><uri>model://part</uri><name>{name}</name>{pose}{placed}</include>"

    def pose(self, around: list[str]) -> str:
        roll = self.random.random()
        if roll < 0.2:
            return ""
        where = " ".join(f"{self.random.uniform(-5, 5):.3f}" for _ in range(3))
        angles = [self.random.uniform(-3.1, 3.1) if self.random.random() < 0.5 else 0.0 for _ in range(3)]
        attribute = "frame" if self.is_old else "relative_to"
        keys = f" {attribute}='{self.random.choice(around)}'" if around and self.random.random() < 0.5 else ""
        if self.version == "1.9" and roll > 0.7:
            if roll > 0.85:
                keys += " degrees='true'"
                angles = [angle * 50 for angle in angles]
            else:
                x, y, z, w = (self.random.gauss(0, 1) for _ in range(4))
                length = (x * x + y * y + z * z + w * w) ** 0.5
                turn = " ".join(f"{value / length:.9f}" for value in (x, y, z, w))
                return f"<pose{keys} rotation_format='quat_xyzw'>{where} {turn}</pose>"
        return f"<pose{keys}>{where} {' '.join(f'{angle:.4f}' for angle in angles)}</pose>"

    def name(self, letter: str) -> str:
        self.count += 1
        return f"{letter}{self.count}"
