"""The filter of system calls: what it decides for each architecture, and that the kernel takes it."""

import ctypes
import errno
import json
import platform
import struct
import subprocess
import sys
from pathlib import Path

import pytest

from executor.evaluation.sealed import system_calls
from executor.evaluation.sealed.system_calls import ARCHITECTURES, NUMBERS, filter_of, restrict_calls

ROOT = Path(__file__).parents[4]
PID = 4321
OPEN = {"network": True, "ipc": True, "files": True, "pid": None}
SHARED = {"network": False, "ipc": False, "files": False, "pid": PID}
MACHINES = list(ARCHITECTURES)


def decide(program, number, *arguments, architecture):
    """Runs the kernel's program; returns "" for an allowed call, or the name of the error."""
    padded = (*arguments, 0, 0, 0, 0, 0, 0)[:6]
    data = struct.pack("<IIQ6Q", number, architecture, 0, *padded)
    steps = [struct.unpack_from("=HBBI", program, at) for at in range(0, len(program), 8)]
    value, at = 0, 0
    while True:
        code, yes, no, k = steps[at]
        at += 1
        match code:
            case 0x20:
                value = struct.unpack_from("<I", data, k)[0]
            case 0x54:
                value &= k
            case 0x15:
                at += yes if value == k else no
            case 0x35:
                at += yes if value >= k else no
            case 0x45:
                at += yes if value & k else no
            case 0x06:
                return "" if k == 0x7FFF0000 else errno.errorcode[k & 0xFFFF]


@pytest.fixture(params=MACHINES)
def ask(request):
    place = MACHINES.index(request.param)

    def asked(given, name, *arguments):
        program = filter_of(request.param, **given)
        assert len(program) // 8 <= 4096, "the kernel takes no more steps"
        return decide(program, NUMBERS[name][place], *arguments, architecture=ARCHITECTURES[request.param])

    return asked


@pytest.mark.parametrize("family", [0, 1, 17, 38, 40])
def test_sockets_are_of_ip_alone(ask, family):
    assert ask(OPEN, "socket", family, 1) == "EPERM"
    assert ask(OPEN, "socket", 2, 1) == ask(OPEN, "socket", 10, 2) == ask(SHARED, "socket", 2, 2) == ""


def test_netlink_is_for_a_network_of_its_own(ask):
    assert (ask(OPEN, "socket", 16, 3), ask(SHARED, "socket", 16, 3)) == ("", "EPERM")


def test_in_a_shared_network_sockets_have_no_addresses(ask):
    for name in ("bind", "connect", "listen", "sendmsg", "sendmmsg"):
        assert (ask(OPEN, name, 3), ask(SHARED, name, 3)) == ("", "EPERM")
    assert ask(SHARED, "sendto", 3, 1, 1, 0, 0, 0) == ""
    for address in (1, 1 << 32, 1 << 47):
        assert ask(SHARED, "sendto", 3, 1, 1, 0, address, 16) == "EPERM"


@pytest.mark.parametrize(
    ("kind", "error"), [(1, ""), (5, ""), (0x80801, ""), (2, "EPERM"), (0x80002, "EPERM"), (3, "EPERM")]
)
def test_pairs_of_sockets_stay_where_they_are_connected(ask, kind, error):
    assert ask(OPEN, "socketpair", 1, kind) == error


def test_limits_and_priorities_are_its_own(ask):
    for name in ("prlimit64", "sched_setaffinity", "sched_setattr", "sched_setparam", "sched_setscheduler"):
        assert (ask(OPEN, name, 0), ask(OPEN, name, PID)) == ("", "EPERM")
    assert ask(OPEN, "setpriority", 0, 0, 5) == ask(OPEN, "ioprio_set", 1, 0, 5) == ""
    for name, process in (("setpriority", 0), ("ioprio_set", 1)):
        assert {ask(OPEN, name, process, PID), ask(OPEN, name, 2, 0), ask(OPEN, name, 3, 0)} == {"EPERM"}


def test_what_has_no_namespace_is_refused(ask):
    for name in (*system_calls.IPC, *system_calls.METADATA):
        if NUMBERS[name][0] >= 0 <= NUMBERS[name][1]:
            assert (ask(OPEN, name), ask(SHARED, name)) == ("", "EPERM")
    assert ask(SHARED, "ioctl", 3, 0x40086602) == ask(SHARED, "ioctl", 3, 0x401C5820) == "EPERM"
    assert ask(SHARED, "ioctl", 3, 0x5401) == ask(OPEN, "ioctl", 3, 0x40086602) == ""


def test_signals_stay_in_the_process_where_the_kernel_does_not_see_to_it(ask):
    for name in ("kill", "tgkill", "rt_sigqueueinfo", "rt_tgsigqueueinfo"):
        assert (ask(OPEN, name, 1), ask(SHARED, name, 1), ask(SHARED, name, PID)) == ("", "EPERM", "")
    assert ask(SHARED, "kill", 0) == ""
    assert ask(SHARED, "tkill", PID) == ask(SHARED, "pidfd_send_signal", 3) == "EPERM"


def test_threads_and_processes_start_but_no_namespaces(ask):
    assert ask(OPEN, "clone3") == "ENOSYS"
    assert ask(OPEN, "clone", 0x3D0F00) == ask(OPEN, "clone", 0x01200011) == ""
    for flag in (0x20000, 0x02000000, 0x04000000, 0x08000000, 0x10000000, 0x20000000, 0x40000000):
        assert ask(OPEN, "clone", flag | 17) == "EPERM"
    for name in system_calls.NEVER:
        assert ask(OPEN, name) == "EPERM"


@pytest.mark.parametrize("machine", MACHINES)
def test_other_architectures_and_numbers_are_refused(machine):
    program = filter_of(machine, **OPEN)
    number = NUMBERS["socketpair"][MACHINES.index(machine)]
    own = ARCHITECTURES[machine]
    assert decide(program, number, 1, 1, architecture=own) == ""
    assert decide(program, number, 1, 1, architecture=0x40000003) == "EPERM"  # 32 bits, where numbers differ
    assert decide(program, 0x40000000 | number, 1, 1, architecture=own) == "EPERM"


TRIES = """
import json, os, resource, socket, sys, threading
from executor.evaluation.sealed.system_calls import restrict_calls

restrict_calls(network=False, ipc=False, files=False, signals=False)
found = []

def try_(name, attempt):
    try:
        attempt()
    except PermissionError:
        found.append(name)

pair = socket.socketpair()
pair[0].send(b"x")
assert pair[1].recv(1) == b"x"
thread = threading.Thread(target=found.append, args=("a thread",))
thread.start()
thread.join()
os.kill(os.getpid(), 0)
resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
try_("unix", lambda: socket.socket(socket.AF_UNIX))
try_("bind", lambda: socket.socket().bind(("127.0.0.1", 0)))
try_("parent", lambda: os.kill(os.getppid(), 0))
try_("mode", lambda: os.chmod(sys.argv[1], 0o600))
if os.fork() == 0:
    try_("of a child", lambda: socket.socket(socket.AF_UNIX))
    os._exit(len(found))
found.append(os.waitstatus_to_exitcode(os.wait()[1]))
print(json.dumps(found))
"""


def test_the_kernel_takes_the_filter_for_all_that_is_started(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", TRIES, tmp_path], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == ["a thread", "unix", "bind", "parent", "mode", 6]


def test_a_machine_without_such_a_filter_is_named(monkeypatch):
    monkeypatch.setattr(platform, "machine", lambda: "riscv64")
    with pytest.raises(OSError, match="riscv64"):
        restrict_calls(network=True, ipc=True, files=True, signals=True)


@pytest.mark.parametrize("machine", MACHINES)
def test_the_numbers_are_those_of_the_kernel(machine):
    resolve = ctypes.CDLL(
        "libseccomp.so.2"
    ).seccomp_syscall_resolve_name_arch  # every Debian and Ubuntu has it
    resolve.argtypes = [ctypes.c_uint32, ctypes.c_char_p]
    known = {name: resolve(ARCHITECTURES[machine], name.encode()) for name in NUMBERS}
    own = {name: numbers[MACHINES.index(machine)] for name, numbers in NUMBERS.items()}
    newer = {name for name, number in known.items() if number == -1}  # than this libseccomp
    assert newer <= {"fchmodat2", "file_setattr", "removexattrat", "setxattrat"}
    for name in known.keys() - newer:
        assert own[name] == max(-1, known[name]), name
