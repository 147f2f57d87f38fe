"""A process that asks itself to end, and one whose parent has ended."""

import subprocess
import sys

ASKS = """
import signal, threading
from ai4u_edu.base.process_signals import ask_to_end
signal.signal(signal.SIGTERM, lambda *_: ended.append(True))
ended = []
asking = threading.Thread(target=ask_to_end)
asking.start()
asking.join()
print(ended)
"""
CHILD = """
import sys, time, psutil
from ai4u_edu.base.process_signals import has_ended
parent = psutil.Process().parent()
print(has_ended(parent), flush=True)
sys.stdin.read()  # until the parent ends
while not has_ended(parent):
    time.sleep(0.01)
print(True, flush=True)
"""
PARENT = """
import subprocess, sys
child = subprocess.Popen([sys.executable, "-c", {program!r}], stdin=subprocess.PIPE)
sys.stdin.readline()
"""


def test_the_handler_is_called_and_not_the_process_ended() -> None:
    done = subprocess.run([sys.executable, "-c", ASKS], capture_output=True, text=True, check=True)
    assert done.stdout == "[True]\n"


def test_a_parent_that_has_ended_is_noticed() -> None:
    program = PARENT.format(program=CHILD)
    with subprocess.Popen(
        [sys.executable, "-c", program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as parent:
        assert parent.stdin is not None
        assert parent.stdout is not None
        assert parent.stdout.readline() == "False\n"
        parent.stdin.write("\n")
        parent.stdin.close()
        assert parent.stdout.readline() == "True\n"
