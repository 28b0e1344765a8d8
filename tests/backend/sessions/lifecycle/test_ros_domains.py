"""Domains that other programs of this host use are seen by their ports."""

from __future__ import annotations

import os
import socket

import pytest

from backend.sessions.lifecycle import ros_domains, writes
from backend.sessions.lifecycle.ros_domains import domains_on_this_host
from backend.sessions.models import Session

pytestmark = pytest.mark.django_db(transaction=True)


def bound(domain: int) -> socket.socket:
    """A socket as a participant of a domain has it."""
    found = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    found.bind(("127.0.0.1", 7400 + 250 * domain + 10))
    return found


def test_a_domain_is_seen_while_its_port_is_bound():
    before = domains_on_this_host()
    domain = next(each for each in range(150, 200) if each not in before)
    with bound(domain):
        assert domains_on_this_host() - before == {domain}
    assert domain not in domains_on_this_host()


def test_a_session_keeps_out_of_the_graph_of_other_programs(api, project, fake_manager, monkeypatch):
    fake_manager("echo")
    first = next(each for each in range(1, 100) if not {each, each + 1} & domains_on_this_host())
    domains = range(first, first + 2)
    monkeypatch.setattr(ros_domains, "ROS_DOMAINS", domains)
    first_choice = os.getpid() % 2  # servers begin at different domains
    with bound(domains[first_choice]):
        api.post(f"projects/{project['id']}/session")
    assert Session.objects.get().ros_domain_id == domains[1 - first_choice]
    writes.end_all_sessions()


def test_a_session_starts_also_where_every_domain_has_programs(api, project, fake_manager, monkeypatch):
    fake_manager("echo")
    only = next(each for each in range(1, 100) if each not in domains_on_this_host())
    monkeypatch.setattr(ros_domains, "ROS_DOMAINS", range(only, only + 1))
    with bound(only):
        api.post(f"projects/{project['id']}/session")
    assert Session.objects.get().ros_domain_id == only
    writes.end_all_sessions()
