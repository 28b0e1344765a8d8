from executor.world.physics.collision import EPISODE_GAP_S, Collision, CollisionCounter, ContactCounter


def test_a_long_scrape_is_one_collision() -> None:
    counter = CollisionCounter()
    found = [counter.observe(i * 0.01, "wall") for i in range(300)]
    assert [collision for collision in found if collision] == [Collision(0.0, "wall")]
    assert counter.count == 1


def test_a_bounce_belongs_to_its_collision() -> None:
    counter = CollisionCounter()
    assert counter.observe(1.0, "wall")
    assert counter.observe(1.0 + EPISODE_GAP_S / 2, None) is None
    assert counter.observe(1.0 + EPISODE_GAP_S * 0.9, "wall") is None
    assert counter.count == 1


def test_after_a_pause_it_is_another_one() -> None:
    counter = CollisionCounter()
    counter.observe(1.0, "wall")
    assert counter.observe(1.1 + EPISODE_GAP_S, "crate") == Collision(1.1 + EPISODE_GAP_S, "crate")
    assert counter.count == 2


def test_touching_nothing_is_no_collision() -> None:
    counter = CollisionCounter()
    assert counter.observe(1.0, None) is None
    assert counter.count == 0


def test_who_caused_a_contact_is_decided_when_it_begins() -> None:
    counter = ContactCounter()
    assert counter.observe(1.0, None, "ada", drives_towards=False) == [Collision(1.0, "ada", is_hit=True)]
    assert counter.observe(1.1, None, "ada", drives_towards=True) == []
    assert counter.observe(3.0, None, "ada", drives_towards=True) == [Collision(3.0, "ada")]
    assert counter.observe(3.1, None, "ada", drives_towards=False) == []
    assert (counter.collisions.count, counter.hits.count) == (1, 1)


def test_a_wall_is_never_who_hits() -> None:
    counter = ContactCounter()
    assert counter.observe(1.0, "wall", None, drives_towards=False) == [Collision(1.0, "wall")]
    assert counter.hits.count == 0
