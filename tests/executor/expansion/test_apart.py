"""Xacro is expanded in a child: places are true, packages are found, and nothing outside is read."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.expansion.apart import ExpandError, Source, expand_apart, has_macros
from tree_gardener.packages import Packages, Place, installed_places

if TYPE_CHECKING:
    from pathlib import Path

HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """Returns a project with a robot whose macros lie in another package."""
    root = tmp_path / "project"
    for name in ("cart_description", "parts"):
        (root / name / "urdf").mkdir(parents=True)
        (root / name / "package.xml").write_text(f"<package><name>{name}</name></package>")
    (root / "parts" / "urdf" / "wheel.xacro").write_text(
        f'{HEAD}<xacro:macro name="wheel" params="side radius:=0.1">\n'
        '  <link name="${side}">\n'
        '    <visual><geometry><sphere radius="${radius * 2}"/></geometry></visual></link>\n'
        "</xacro:macro></robot>"
    )
    return root


def expanded(project: Path, text: str, name: str = "cart.urdf.xacro", **arguments: str) -> Source:
    file = project / "cart_description" / "urdf" / name
    file.write_text(HEAD + text + "</robot>")
    return expand_apart(file, Packages(file.parent, [Place("the project", project)]), arguments)


def refused(project: Path, text: str) -> tuple[str, str, int]:
    with pytest.raises(ExpandError) as error:
        expanded(project, text)
    return str(error.value), error.value.file.name, error.value.line


INCLUDE = '<xacro:include filename="$(find parts)/urdf/wheel.xacro"/>\n'


def test_macros_of_another_package_are_expanded_and_each_line_knows_its_place(project: Path) -> None:
    made = expanded(project, f'{INCLUDE}<xacro:wheel side="left"/>\n<link name="base"/>')
    lines = made.text.decode().splitlines()
    at = {
        word: next(i for i, line in enumerate(lines, 1) if word in line) for word in ('"left"', "0.2", "base")
    }
    places = {word: (made.place(line)[0].name, made.place(line)[1]) for word, line in at.items()}
    assert places == {'"left"': ("wheel.xacro", 3), "0.2": ("wheel.xacro", 4), "base": ("cart.urdf.xacro", 4)}


def test_arguments_variables_and_yaml_are_read(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROBOT_KIND", "heavy")
    monkeypatch.setenv("BT_STUDIO_KEY", "secret")
    (project / "cart_description" / "sizes.yaml").write_text("wheel: {radius: 0.25}\n")
    text = (
        '<xacro:arg name="side" default="left"/><xacro:arg name="top" default="flat"/>\n'
        '<xacro:property name="sizes" value="${xacro.load_yaml(\'$(find cart_description)/sizes.yaml\')}"/>\n'
        '<link name="$(arg side)_$(arg top)_$(optenv ROBOT_KIND light)_$(optenv BT_STUDIO_KEY none)"/>\n'
        "<link name=\"r${sizes['wheel']['radius']}\"/>"
    )
    made = expanded(project, text, side="right").text
    assert b'name="right_flat_heavy_none"' in made
    assert b'name="r0.25"' in made


def test_the_folder_of_a_package_is_written_as_its_name(project: Path) -> None:
    text = (
        '<link name="a"><visual><geometry><mesh filename="{}$(find parts)/a.stl"/></geometry></visual></link>'
    )
    for scheme in ("", "file://"):
        made = expanded(project, text.format(scheme)).text.decode()
        assert 'filename="package://parts/a.stl"' in made
        assert str(project) not in made


@pytest.mark.parametrize(
    ("text", "message", "place"),
    [
        ('<link name="${nothing}"/>', "nothing", ("cart.urdf.xacro", 2)),
        (
            f'{INCLUDE}\n<xacro:wheel side="a" radius="${{\'x\'}}"/><xacro:wheel/>',
            "Undefined parameters",
            ("cart.urdf.xacro", 4),
        ),
        (
            f'{INCLUDE}\n<xacro:wheel side="a" radius="${{[]}}"/><link name="${{1/0}}"/>',
            "division",
            ("cart.urdf.xacro", 4),
        ),
        (f'{INCLUDE}<xacro:wheel side="a" radius="${{dict()}}"/>', "unsupported operand", ("wheel.xacro", 4)),
        ("<xacro:whel/>", "unknown macro name: xacro:whel", ("cart.urdf.xacro", 2)),
        (
            '\n<xacro:include filename="no.xacro"/>',
            "the file no.xacro cannot be read: No such file",
            ("cart.urdf.xacro", 3),
        ),
        (
            '<xacro:include filename="cart.urdf.xacro"/>',
            "cart.urdf.xacro includes itself",
            ("cart.urdf.xacro", 2),
        ),
        (
            '<xacro:include filename="$(find ghost)/a"/>',
            "no folder is the package 'ghost'",
            ("cart.urdf.xacro", 2),
        ),
        ('<link name="$(arg side)"/>', "there is no argument side", ("cart.urdf.xacro", 2)),
        ('<link name="$(env SIDE)"/>', "$(optenv NAME DEFAULT)", ("cart.urdf.xacro", 2)),
        ('<xacro:if value="maybe"><a/></xacro:if>', "not a boolean", ("cart.urdf.xacro", 2)),
        ("\n<link>", "mismatched tag", ("cart.urdf.xacro", 3)),
        (
            '<xacro:macro name="m" params=""><xacro:m/></xacro:macro><xacro:m/>',
            "call each other without end",
            ("cart.urdf.xacro", 2),
        ),
    ],
)
def test_an_error_has_its_true_file_and_line(
    project: Path, text: str, message: str, place: tuple[str, int]
) -> None:
    said, *where = refused(project, text)
    assert message in said
    assert tuple(where) == place
    assert str(project) not in said


def test_an_include_of_a_package_that_nobody_has_is_left_out_where_that_is_wanted(project: Path) -> None:
    file = project / "cart_description" / "a.xacro"
    include = f'{HEAD}<xacro:include filename="$(find ghost)/a.xacro"/>\n'
    file.write_text(f'{include}<link name="a"/></robot>')
    packages = Packages(file.parent, [Place("the project", project)])
    made = expand_apart(file, packages, is_lenient=True)
    assert b'<link name="a"/>' in made.text
    [note] = made.notes
    assert note.startswith("a.xacro:2: the include is left out: no folder is the package 'ghost'")
    with pytest.raises(ExpandError, match="no folder is the package 'ghost'"):
        expand_apart(file, packages)
    file.write_text(f"{include}<xacro:wheel/></robot>")
    with pytest.raises(
        ExpandError, match=r"unknown macro name: xacro:wheel; a\.xacro:2: the include is left out"
    ):
        expand_apart(file, packages, is_lenient=True)


def test_a_ring_of_files_and_a_document_type_are_refused(project: Path) -> None:
    folder = project / "cart_description" / "urdf"
    (folder / "one.xacro").write_text(f'{HEAD}<xacro:include filename="two.xacro"/></robot>')
    (folder / "two.xacro").write_text(f'{HEAD}<xacro:include filename="one.xacro"/></robot>')
    said, file, line = refused(project, '<xacro:include filename="one.xacro"/>')
    assert (said, file, line) == ("xacro: one.xacro includes itself", "two.xacro", 2)
    (folder / "one.xacro").write_text('<!DOCTYPE robot [<!ENTITY a "b">]><robot/>')
    said, file, _ = refused(project, '<xacro:include filename="one.xacro"/>')
    assert (said, file) == ("xacro: xacro needs no DOCTYPE", "one.xacro")


def test_no_file_outside_of_the_project_is_read(project: Path) -> None:
    secret = project.parent / "secret.yaml"
    secret.write_text("word: hidden\n")
    (project / "cart_description" / "link.yaml").symlink_to(secret)
    (secret.parent / "secret.xacro").write_text(f'{HEAD}<link name="hidden"/></robot>')
    for path in (str(secret), "../../../secret.yaml", "../link.yaml", "/etc/hostname"):
        said, *_ = refused(project, f"<link name=\"${{xacro.load_yaml('{path}')}}\"/>")
        assert "cannot be read" in said
        assert "hidden" not in said
    for path in ("../../../secret.xacro", "/etc/passwd", "/proc/self/environ"):
        said, *_ = refused(project, f'<xacro:include filename="{path}"/>')
        assert "cannot be read" in said
    for name in ("../../../*.xacro", "/etc/pass*"):
        assert b"hidden" not in expanded(project, f'<xacro:include filename="{name}"/>').text


@pytest.mark.parametrize(
    ("code", "message"),
    [
        ("__import__('socket').socket()", "socket.py cannot be read"),
        ("__import__('subprocess').run(['touch', '{file}'])", "subprocess.py cannot be read"),
        ("__import__('os').system('touch {file}')", "may not do that"),
        ("__import__('os').posix_spawn('/bin/touch', ['touch', '{file}'], dict())", "may not do that"),
        ("open('{file}', 'w')", "may not do that"),
        ("__import__('os').listdir('/')", "lies outside"),
        ("open('/proc/self/environ').read()", "lies outside"),
    ],
)
def test_no_socket_opens_no_program_starts_and_nothing_is_written(
    project: Path, code: str, message: str
) -> None:
    """A comprehension reaches the builtins of a module through a class: xacro's own filter misses that."""
    file = project / "started"
    code = code.replace("{file}", str(file))
    classes = "().__class__.__base__.__subclasses__()"
    reached = f"[c for x in [0] for c in {classes} if c.__name__ == 'catch_warnings']"
    builtins = f"for c in {reached} for b in [c()._module.__builtins__]"
    call = f"[b['eval'](&quot;{code}&quot;, dict(__builtins__=b)) {builtins}]"
    said, *_ = refused(project, f'<link name="${{{call}}}"/>')
    assert message in said
    assert not file.exists()


def test_limits_hold(project: Path) -> None:
    said, *_ = refused(project, '<link name="${len(list(range(10**9)))}"/>')
    assert "512 MB" in said
    said, *_ = refused(project, "<link name=\"${len('a' * (17 * 1024 * 1024)) * ('a' * 2)}\"/>")
    assert "16 MB" in said


def test_what_is_installed_can_be_read(project: Path, tmp_path: Path) -> None:
    share = tmp_path / "ros" / "share" / "extra"
    share.mkdir(parents=True)
    (share / "a.xacro").write_text(f'{HEAD}<link name="extra"/></robot>')
    file = project / "a.xacro"
    file.write_text(f'{HEAD}<xacro:include filename="$(find extra)/a.xacro"/></robot>')
    installed = installed_places({"AMENT_PREFIX_PATH": str(tmp_path / "ros")})
    made = expand_apart(file, Packages(project, [Place("the project", project)], installed))
    assert b'<link name="extra"/>' in made.text


def test_macros_are_known_by_name_and_by_content(tmp_path: Path) -> None:
    assert has_macros(tmp_path / "a.xacro", b"<robot/>")
    assert has_macros(tmp_path / "a.urdf", b'<robot><xacro:include filename="b"/></robot>')
    assert has_macros(tmp_path / "a.urdf", b'<robot><link name="${a}"/></robot>')
    assert not has_macros(tmp_path / "a.urdf", b'<robot xmlns:xacro="http://ros.org/xacro"/>')
