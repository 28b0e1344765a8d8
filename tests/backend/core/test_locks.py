"""Locks by name."""

from __future__ import annotations

from django.db import transaction

from backend.core.locks import lock_number, transaction_lock


def test_names_have_numbers_of_64_bits() -> None:
    numbers = {lock_number(name) for name in ("a", "b", "places of sessions")}
    assert len(numbers) == 3
    assert all(-(2**63) <= number < 2**63 for number in numbers)
    assert lock_number("a") == lock_number("a")


def test_a_transaction_takes_its_lock(db, django_assert_num_queries):
    with transaction.atomic():
        transaction_lock("a")
        transaction_lock("a", shared=True)
