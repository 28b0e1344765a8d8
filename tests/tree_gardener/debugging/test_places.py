from tests.tree_gardener.debugging.trees import tree_of
from tree_gardener.debugging import Place, nodes_at, place_of
from tree_gardener.debugging.places import instance_of, key_of

SUB = '<BehaviorTree ID="Sub"><Leaf name="{name}" _bts_id="n7"/></BehaviorTree>'
MAIN = '<Sequence><SubTree ID="Sub" name="{one}" _bts_id="n1"/><SubTree ID="Sub" _bts_id="n2"/></Sequence>'


def tree(one: str = "one", name: str = "x.S"):
    return tree_of(MAIN.format(one=one), SUB.format(name=name))


def test_a_place_is_all_instances_of_a_block_or_one() -> None:
    nodes = tree().nodes
    leaf = nodes[2]
    assert place_of(leaf) == Place("Sub", "n7")
    assert nodes_at(nodes, place_of(leaf)) == [nodes[2], nodes[4]]
    assert nodes_at(nodes, place_of(leaf, one_instance=True)) == [leaf]


def test_a_place_follows_renames() -> None:
    places = [place_of(node, one_instance=True) for node in tree().nodes[1:]]
    renamed = tree("other", "y.S").nodes
    assert [nodes_at(renamed, place) for place in places] == [[node] for node in renamed[1:]]


def test_without_ids_a_place_is_a_path() -> None:
    nodes = tree_of(
        '<SubTree ID="Sub" name="one"/>',
        '<BehaviorTree ID="Sub"><Inverter><Leaf name="x.S"/></Inverter></BehaviorTree>',
    ).nodes
    assert (key_of(nodes[1]), key_of(nodes[2])) == ("Inverter::2", "x.S")
    assert instance_of(nodes[2]) == ("one",)
    assert nodes_at(nodes, Place("Sub", "x.S", ("two",))) == []
