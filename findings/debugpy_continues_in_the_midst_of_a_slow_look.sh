#!/usr/bin/env bash
# Guess: between `stopped` and the client's `continue`, debugpy sends no `continued`: a program that is held at
# a breakpoint is held until the client says otherwise.
# Seen: debugpy 1.8.22, where the parts of a value take longer than 3 s (a slow property; the client asked
# `variables`), says `continued` for all threads, lets the others run, and says `stopped` again at the end. The
# client asked for nothing of it, and the second stop looks like another hit of the same breakpoint. Who pauses
# a simulation for a stop has let it go on. PYDEVD_UNBLOCK_THREADS_ON_VARIABLES_TIMEOUT=-1 in the program's
# environment switches it off.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check debugpy==1.8.22
cat > program.py <<'PYTHON'
import time


class Arm:
    @property
    def pose(self):
        time.sleep(4.5)
        return 1.0


arm = Arm()
print("held", arm is None)
PYTHON
cat > client.py <<'PYTHON'
import json
import os
import subprocess
import sys
import time

program = os.path.abspath("program.py")
adapter = subprocess.Popen(
    [sys.executable, "-m", "debugpy.adapter"], stdin=subprocess.PIPE, stdout=subprocess.PIPE
)
seq, seen = 0, []


def send(command, **arguments):
    global seq
    seq += 1
    text = json.dumps({"seq": seq, "type": "request", "command": command, "arguments": arguments}).encode()
    adapter.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(text), text))
    adapter.stdin.flush()
    return seq


def until(wanted):
    while True:
        length = 0
        while (line := adapter.stdout.readline().strip()):
            name, _, value = line.partition(b":")
            length = int(value) if name.lower() == b"content-length" else length
        message = json.loads(adapter.stdout.read(length))
        if message.get("event") in ("stopped", "continued"):
            seen.append(message["event"])
        if wanted(message):
            return message


def answer(command, **arguments):
    mine = send(command, **arguments)
    return until(lambda message: message.get("request_seq") == mine)["body"]


send("initialize", clientID="finding", adapterID="debugpy", pathFormat="path")
send(
    "launch", program=program, python=[sys.executable], console="internalConsole", justMyCode=True,
    env=json.loads(sys.argv[1]),
)
until(lambda message: message.get("event") == "initialized")
line = open(program).read().split("\n").index('print("held", arm is None)') + 1
send("setBreakpoints", source={"path": program}, breakpoints=[{"line": line}])
send("configurationDone")
thread = until(lambda message: message.get("event") == "stopped")["body"]["threadId"]
frame = answer("stackTrace", threadId=thread)["stackFrames"][0]["id"]
arm = answer("evaluate", expression="arm", frameId=frame, context="watch")["variablesReference"]
[pose] = [part for part in answer("variables", variablesReference=arm)["variables"] if part["name"] == "pose"]
time.sleep(1)
answer("evaluate", expression="1", frameId=frame, context="watch")  # what was said until now is read
print(pose["value"], " ".join(seen))
adapter.kill()
PYTHON
expect() {
  found=$(env/bin/python client.py "$1")
  echo "$1: $found"
  [ "$found" = "$2" ]
}
expect '{}' "1.0 stopped continued stopped"
expect '{"PYDEVD_UNBLOCK_THREADS_ON_VARIABLES_TIMEOUT": "-1"}' "1.0 stopped"
