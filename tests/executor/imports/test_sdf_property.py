"""The rules of universes accept whatever the importer writes, for any world."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

from hypothesis import given, settings
from hypothesis import strategies as st

from executor.imports.worlds import import_sdf
from executor.robots.urdf import parse_urdf
from executor.universes import UniverseError, parse_universe

if TYPE_CHECKING:
    from hypothesis.strategies import DrawFn

NUMBERS = st.one_of(
    st.floats(-20, 20, allow_nan=False).map(lambda value: f"{value:.6g}"),
    st.sampled_from(["0", "-1", "1e9", "1e-12", "nan", "inf", "", "x", "3e5", "0.05"]),
)
NAMES = st.one_of(
    st.sampled_from(
        ["link", "a", "ground", "robot", "world", "Ä ö", "", "x" * 200, "1st", "on", "null", "a::b"]
    ),
    st.text("abz_ -:/.#'{}", max_size=12),
)
TAGS = st.sampled_from(
    ["box", "sphere", "cylinder", "plane", "mesh", "heightmap", "capsule", "cone", "ellipsoid", "polyline"]
)
JOINTS = st.sampled_from(["revolute", "prismatic", "fixed", "ball", "continuous", "", "screw"])
ENDS = st.sampled_from(["world", "a", "b", "__model__", "f", "nothing"])


def escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace("'", "&apos;")


@st.composite
def numbers(draw: DrawFn, count: int, *, mostly: str = "1") -> str:
    if draw(st.integers(0, 3)):
        return " ".join([mostly] * count)
    return " ".join(draw(NUMBERS) for _ in range(count))


@st.composite
def poses(draw: DrawFn) -> str:
    if draw(st.booleans()):
        return ""
    extra = draw(st.sampled_from(["", "degrees='true'", "relative_to='f'", "frame='f'"]))
    return f"<pose {extra}>{draw(numbers(6, mostly='0.5'))}</pose>"


@st.composite
def parts(draw: DrawFn) -> str:
    kind, tag = draw(st.sampled_from(["visual", "collision"])), draw(TAGS)
    inside = "".join(
        f"<{key}>{draw(numbers(count))}</{key}>"
        for key, count in (("size", 2 if tag == "plane" else 3), ("radius", 1), ("length", 1), ("scale", 3))
        if draw(st.integers(0, 2))
    )
    color = f"<material><diffuse>{draw(numbers(4))}</diffuse></material>"
    mu = f"<surface><friction><ode><mu>{draw(numbers(1))}</mu></ode></friction></surface>"
    shape = f"<geometry><{tag}><uri>a.stl</uri>{inside}</{tag}></geometry>"
    return f"<{kind} name='{escaped(draw(NAMES))}'>{draw(poses())}{shape}{color}{mu}</{kind}>"


@st.composite
def models(draw: DrawFn) -> str:
    links = "".join(
        f"<link name='{name}'>{draw(poses())}<inertial><mass>{draw(numbers(1))}</mass></inertial>"
        f"{''.join(draw(st.lists(parts(), max_size=3)))}</link>"
        for name in draw(st.sampled_from([("a",), ("a", "b")]))
    )
    joint = ""
    if draw(st.booleans()):
        ends = f"<parent>{draw(ENDS)}</parent><child>{draw(ENDS)}</child>"
        axis = f"<axis><xyz>{draw(numbers(3))}</xyz><limit><lower>{draw(numbers(1))}</lower></limit></axis>"
        joint = f"<joint name='j' type='{draw(JOINTS)}'>{ends}{axis}</joint>"
    static = draw(st.sampled_from(["", "<static>true</static>", "<static>0</static>"]))
    frame = f"<frame name='f'>{draw(poses())}</frame>"
    return f"<model name='{escaped(draw(NAMES))}'>{static}{draw(poses())}{frame}{links}{joint}</model>"


@st.composite
def others(draw: DrawFn) -> str:
    points = "".join(
        f"<waypoint><time>{draw(numbers(1))}</time><pose>{draw(numbers(6))}</pose></waypoint>"
        for _ in range(3)
    )
    actor = f"<actor name='{escaped(draw(NAMES))}'><script><trajectory>{points}</trajectory></script></actor>"
    light = f"<light name='l' type='directional'><direction>{draw(numbers(3))}</direction></light>"
    return draw(st.sampled_from([actor, light, actor + light, ""]))


@st.composite
def worlds(draw: DrawFn) -> bytes:
    version = draw(st.sampled_from(["1.4", "1.6", "1.9", "1.12"]))
    inside = "".join([*draw(st.lists(models(), max_size=4)), draw(others())])
    name = escaped(draw(NAMES))
    return f"<sdf version='{version}'><world name='{name}'><frame name='f'/>{inside}</world></sdf>".encode()


@settings(max_examples=200, deadline=None)
@given(worlds())
def test_what_is_imported_is_accepted(world: bytes) -> None:
    with contextlib.suppress(UniverseError):  # refused, with its line
        made = import_sdf(world)
        universe = parse_universe(made.text)
        assert made.things == len(universe.models) + len(universe.actors) > 0
        for model in universe.models:
            if model.shape == "urdf":
                parse_urdf(made.files[model.file], model.file)
