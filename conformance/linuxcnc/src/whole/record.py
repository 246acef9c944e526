#!/usr/bin/env python3
"""Runs one program on LinuxCNC, and writes what the servo thread commands in each cycle.

LinuxCNC starts this script as its display, and shuts itself down when it exits. The program is `programs/main.ngc`, the
samples go to `samples.txt`; the last column says whether the program runs. What went wrong is in a line that begins
with the mark.
"""

import json
import os
import subprocess
import sys
import time

import hal
import linuxcnc

MARK = "@gaugeblock@ "
PAUSE = 0.01
# Seconds of rest that are recorded before and after the motion.
REST = 0.2
# Seconds until the controller must have taken up the program.
START = 5


def report(**what):
    sys.stdout.write(MARK + json.dumps(what) + "\n")
    sys.stdout.flush()


def ready(command):
    """The program is open and the machine on."""
    command.state(linuxcnc.STATE_ESTOP_RESET)
    command.wait_complete()
    command.state(linuxcnc.STATE_ON)
    command.wait_complete()
    command.mode(linuxcnc.MODE_AUTO)
    command.wait_complete()
    command.program_open(os.path.abspath("programs/main.ngc"))
    command.wait_complete()


def run(command, status, errors):
    """What the controller complains of; none where the program came to its end."""
    started = time.monotonic()
    command.auto(linuxcnc.AUTO_RUN, 0)
    begun = False
    while True:
        status.poll()
        message = errors.poll()
        # A program writes messages into the same channel.
        if message and message[0] in (linuxcnc.NML_ERROR, linuxcnc.OPERATOR_ERROR):
            return str(message[1])
        idle = status.interp_state == linuxcnc.INTERP_IDLE
        begun = begun or not idle
        # The interpreter can be idle before the task controller has executed the last dwell.
        executed = status.exec_state == linuxcnc.EXEC_DONE and status.state == linuxcnc.RCS_DONE
        if begun and idle and executed and status.inpos and status.queue == 0:
            return None
        if not begun and time.monotonic() - started > START:
            # Samples of nothing would accuse the controller of what it was never asked.
            return "the program was not taken up"
        time.sleep(PAUSE)


def main():
    command, status, errors = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()
    component = hal.component("recorder")
    component.newpin("running", hal.HAL_BIT, hal.HAL_OUT)
    component.ready()
    hal.connect("recorder.running", "running")
    ready(command)
    with open("samples.txt", "w", encoding="ascii") as samples:
        sampler = subprocess.Popen(["halsampler", "-t"], stdout=samples)
        time.sleep(REST)
        component["running"] = True
        complaint = run(command, status, errors)
        component["running"] = False
        time.sleep(REST)
        sampler.terminate()
        sampler.wait()
    if complaint:
        report(failed=complaint)
    else:
        report(recorded=True)


main()
