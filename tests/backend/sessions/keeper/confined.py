"""`python -m tests.backend.sessions.keeper.confined PROGRAM…`: a program under a session's seccomp profile.

As Docker's runtime does it, with libseccomp, which every Debian and Ubuntu has.
"""

from __future__ import annotations

import ctypes
import json
import os
import sys

from backend.sessions.keeper.plan import seccomp_profile

ALLOW, ERRNO = 0x7FFF0000, 0x00050000
EPERM = 1
OPERATORS = {"SCMP_CMP_EQ": 4, "SCMP_CMP_MASKED_EQ": 7}


class Comparison(ctypes.Structure):
    _fields_ = (
        ("index", ctypes.c_uint),
        ("op", ctypes.c_int),
        ("value", ctypes.c_uint64),
        ("value_two", ctypes.c_uint64),
    )


def confine():
    """Applies the profile to this process and its children."""
    lib = ctypes.CDLL("libseccomp.so.2")
    lib.seccomp_init.restype = ctypes.c_void_p
    lib.seccomp_rule_add_array.argtypes = [
        *(ctypes.c_void_p, ctypes.c_uint32, ctypes.c_int, ctypes.c_uint),
        ctypes.POINTER(Comparison),
    ]
    profile = json.loads(seccomp_profile())
    assert profile["defaultAction"] == "SCMP_ACT_ERRNO"
    context = lib.seccomp_init(ERRNO | EPERM)
    unknown = []
    for rule in profile["syscalls"]:
        action = ALLOW if rule["action"] == "SCMP_ACT_ALLOW" else ERRNO | rule["errnoRet"]
        given = [
            Comparison(arg["index"], OPERATORS[arg["op"]], arg["value"], arg.get("valueTwo", 0))
            for arg in rule.get("args", [])
        ]
        for name in rule["names"]:
            number = lib.seccomp_syscall_resolve_name(name.encode())
            if number == -1:  # newer than this libseccomp; Docker's runtime leaves it out, too
                unknown.append(name)
                continue
            made = (Comparison * len(given))(*given)
            assert lib.seccomp_rule_add_array(context, action, number, len(given), made) == 0, name
    assert len(unknown) < 40, unknown
    assert lib.seccomp_load(ctypes.c_void_p(context)) == 0


if __name__ == "__main__":
    confine()
    os.execv(sys.argv[1], sys.argv[1:])  # noqa: S606 - a program of the tests
