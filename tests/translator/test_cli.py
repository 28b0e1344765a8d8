"""The verbs of the command line: exit status, stderr, JSON."""

from __future__ import annotations

import json
import shutil
import sys
import zipfile

import pytest

from backend.cli import main as cli
from tests.translator.conftest import EXAMPLES, ROOT
from translator import load, to_models_xml, to_xml, to_xsd
from translator.archive import read_folder

EXAMPLE = str(ROOT / "examples" / EXAMPLES[0])
XML = '<root BTCPP_format="4"><BehaviorTree ID="T"><Foo speed="1"/></BehaviorTree></root>'


@pytest.fixture
def run(monkeypatch, capfdbinary):
    """Runs one verb; returns exit status, stdout and stderr."""

    def work(*arguments):
        monkeypatch.setattr(sys, "argv", ["bt-studio", *map(str, arguments)])
        status = 0
        try:
            cli.main()
        except SystemExit as error:
            status = int(error.code or 0)
        out, errors = capfdbinary.readouterr()
        return status, out.decode(), errors.decode()

    return work


def test_check_of_a_sound_project(run):
    assert run("check", EXAMPLE) == (0, f"{EXAMPLE}: no errors\n", "")


def test_check_names_file_line_column_code_and_hint(run, tmp_path):
    (tmp_path / "t.xml").write_text(XML.replace("<Foo", "<Sequence").replace(' speed="1"', ""))
    status, out, errors = run("check", tmp_path / "t.xml")
    assert (status, out) == (1, "")
    assert errors.startswith(f"{tmp_path / 't.xml'}:1:45: BT0104 [n1] Sequence needs at least 1 child")
    assert errors.rstrip().endswith(")")
    status, out, errors = run("check", tmp_path / "t.xml", "--json")
    assert (status, errors) == (1, "")
    assert json.loads(out)["diagnostics"][0]["code"] == "BT0104"


def test_xml_that_cannot_be_read_is_placed_in_the_file(run, tmp_path):
    (tmp_path / "t.xml").write_text("<root>\n<a")
    status, _, errors = run("check", tmp_path / "t.xml")
    assert status == 1
    assert errors.startswith(f"{tmp_path / 't.xml'}:2:")


def test_check_of_an_action(run, tmp_path):
    (tmp_path / "A.py").write_text("class A(:\n")
    status, _, errors = run("check", tmp_path / "A.py")
    assert status == 1
    assert errors.startswith(f"{tmp_path / 'A.py'}:1:")


@pytest.mark.parametrize("verb", ["check", "translate"])
def test_what_is_not_there_is_a_bad_argument(run, verb, tmp_path):
    status, out, errors = run(verb, tmp_path / "nothing.xml")
    assert (status, out) == (2, "")
    assert "no such file" in errors


def test_translate(run, tmp_path):
    project = load(read_folder(ROOT / "examples" / EXAMPLES[0]))
    assert run("translate", EXAMPLE) == (0, to_xml(project), "")
    assert run("translate", EXAMPLE, "-o", tmp_path / "o.xml", "--self-contained") == (0, "", "")
    assert "<Code>" in (tmp_path / "o.xml").read_text()
    assert run("translate", EXAMPLE, "--form-2024")[1].split("\n")[1] == '<Root name="Tree Root">'
    assert run("translate", EXAMPLE, "--models") == (0, to_models_xml(project), "")
    assert run("translate", EXAMPLE, "--xsd") == (0, to_xsd(project), "")
    document = json.loads(run("translate", EXAMPLE, "--json")[1])
    assert document["files"] == {"MainTree.xml": to_xml(project)}


def test_translate_of_a_file_that_is_unchanged(run, tmp_path):
    (tmp_path / "t.xml").write_text(XML)
    status, out, errors = run("translate", tmp_path / "t.xml")
    assert (status, out) == (0, XML)
    assert "BT0613" in errors


def test_self_contained_needs_the_actions(run, tmp_path):
    (tmp_path / "t.xml").write_text(XML)
    (tmp_path / "given").mkdir()
    status, out, errors = run(
        "translate", tmp_path / "t.xml", "--actions", tmp_path / "given", "--self-contained"
    )
    assert (status, out) == (1, "")
    assert "BT0102" in errors


def test_import_then_translate_gives_the_same_bytes(run, tmp_path):
    (tmp_path / "t.xml").write_bytes(XML.replace("><", ">\r\n<").encode())
    status, out, _ = run("import", tmp_path / "t.xml", "-o", tmp_path / "p")
    assert status == 0
    assert "actions/Foo.py" in out
    assert run("translate", tmp_path / "p", "-o", tmp_path / "again.xml")[0] == 0
    assert (tmp_path / "again.xml").read_bytes() == (tmp_path / "t.xml").read_bytes()
    assert run("import", tmp_path / "t.xml", "-o", tmp_path / "p")[0] == 2
    document = json.loads(run("import", tmp_path / "t.xml", "-o", tmp_path / "p.zip", "--json")[1])
    assert document["to_be_written"] == ["Foo"]
    assert run("check", tmp_path / "p.zip")[0] == 0


def test_an_import_says_what_a_repair_would_change_and_makes_it_when_asked(run, tmp_path):
    (tmp_path / "t.xml").write_text(XML.replace("<Foo", '<Foo _post="x := 1 & 1"', 1))
    status, _, errors = run("import", tmp_path / "t.xml", "-o", tmp_path / "p")
    assert status == 1
    assert "BT0740" in errors
    assert "--repair" in errors
    assert not (tmp_path / "p").exists()
    assert run("import", tmp_path / "t.xml", "-o", tmp_path / "p", "--repair")[0] == 0
    assert b"1 &amp; 1" in (tmp_path / "p" / "imports" / "t.xml").read_bytes()


def test_package_and_app(run, tmp_path):
    status, out, errors = run("package", EXAMPLE, "-o", tmp_path / "p.zip", "--name", "my_robot")
    assert (status, errors) == (0, "")
    assert "my_robot" in out
    assert "my_robot/package.xml" in zipfile.ZipFile(tmp_path / "p.zip").namelist()
    assert run("package", EXAMPLE, "-o", tmp_path / "a.zip", "--dockerized")[0] == 0
    assert "execute_docker.py" in zipfile.ZipFile(tmp_path / "a.zip").namelist()
    status, _, errors = run("package", EXAMPLE, "-o", tmp_path / "q.zip", "--name", "My Robot")
    assert status == 1
    assert "BT0900" in errors
    assert not (tmp_path / "q.zip").exists()
    assert (
        json.loads(run("package", EXAMPLE, "-o", tmp_path / "p.zip", "--json")[1])["package"] == EXAMPLES[0]
    )


def test_a_package_of_cpp_and_its_models_come_and_go(run, tmp_path):
    status, out, errors = run("package", EXAMPLE, "--cpp", "-o", tmp_path / "c.zip")
    assert (status, errors) == (0, "")
    name = f"{EXAMPLES[0]}_cpp"
    assert name in out
    with zipfile.ZipFile(tmp_path / "c.zip") as package:
        models = package.read(f"{name}/models/{name}.xml")
    folder = tmp_path / "p"
    shutil.copytree(EXAMPLE, folder)
    (tmp_path / "m.xml").write_bytes(models)
    assert run("import", tmp_path / "m.xml", "--into", folder)[:2] == (0, f"{folder}: 0 stubs written\n")
    new = models.replace(b"<TreeNodesModel>", b'<TreeNodesModel><Action ID="Gate"/>')
    (tmp_path / "m.xml").write_bytes(new.replace(b'default="0.3"', b'default="0.4"'))
    status, out, errors = run("import", tmp_path / "m.xml", "--into", folder)
    assert (status, out) == (0, f"{folder}: 1 stub written\n")
    assert "BT0744" in errors
    assert (folder / "actions" / "Gate.py").is_file()
    document = json.loads(run("import", tmp_path / "m.xml", "--into", folder, "--json")[1])
    assert document["written"] == []
    assert [item["code"] for item in document["diagnostics"]] == ["BT0744"]
    (tmp_path / "m.xml").write_text('<root BTCPP_format="4"/>')
    assert run("import", tmp_path / "m.xml", "--into", folder)[0] == 1
    assert run("import", tmp_path / "m.xml")[0] == 2
