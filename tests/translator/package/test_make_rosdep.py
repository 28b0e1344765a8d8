"""The table of imports is made of rosdistro's lists."""

from __future__ import annotations

from translator.package.make_rosdep import import_names, is_for_ubuntu, make_table


def test_an_import_is_judged_by_the_name_of_its_key() -> None:
    assert import_names("python3-numpy") == ["numpy"]
    assert import_names("python-flask-pip") == ["flask"]
    assert import_names("libopencv-dev") == []


def test_a_package_of_debian_goes_before_one_of_pip() -> None:
    python = {
        "python3-numpy": {"ubuntu": {"noble": ["python3-numpy"]}},
        "python3-numpy-pip": {"ubuntu": {"pip": {"packages": ["numpy"]}}},
        "python3-old": {"ubuntu": {"focal": ["python3-old"]}},
    }
    table = make_table(python, ["rclpy", "py_trees"], "2026-01-01")
    assert table["imports"]["numpy"] == "python3-numpy"
    assert "old" not in table["imports"]
    assert table["ros_packages"] == ["py_trees", "rclpy"]


def test_a_rule_may_be_a_list_or_for_every_release() -> None:
    assert is_for_ubuntu({"ubuntu": ["python3-x"]})
    assert is_for_ubuntu({"ubuntu": {"*": ["python3-x"]}})
    assert not is_for_ubuntu({"debian": ["python3-x"]})
