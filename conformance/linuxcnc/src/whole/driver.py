#!/usr/bin/env python3
"""Drives one LinuxCNC that was started for it: the display of its INI file.

Orders come as JSON, one a line, on standard input; reports go out as JSON behind a mark, one a line, among what the
controller itself prints. Everything is in the current directory, which is private. `driver.py guard COMMAND…` is the
first process of the private process space: when its input ends, it ends, and the kernel ends everything with it.
"""

import json
import os
import shutil
import subprocess
import sys
import threading
import time

MARK = "@gaugeblock@ "
PAUSE = 0.0005
# What a busy machine makes of real time; no answer to anything.
REALTIME_DELAY = "Unexpected realtime delay"
# What may be refused; a switch cannot.
REQUESTS = ("cycle_start", "resume", "pause", "abort", "mode", "mdi")
# How long a motion stands still before it counts as held, seconds.
STILL = 1.0
# In how many cycles a change has reached the samples.
CYCLES = 4


def guard(command):
    """Starts the controller, hands orders through, and ends with either end of them."""
    child = subprocess.Popen(command, stdin=subprocess.PIPE)

    def hand_through():
        for line in sys.stdin.buffer:
            try:
                child.stdin.write(line)
                child.stdin.flush()
            except OSError:
                break
        os._exit(0)

    threading.Thread(target=hand_through, daemon=True).start()
    os._exit(child.wait() & 0xFF)


def report(**what):
    sys.stdout.write(MARK + json.dumps(what) + "\n")
    sys.stdout.flush()


def is_running(name):
    """Whether a process of this name is in the private process space and is no zombie."""
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                with open(f"/proc/{entry}/stat", encoding="utf-8") as file:
                    text = file.read()
            except OSError:
                continue
            if f"({name})" in text and text.rsplit(")", 1)[1].split()[0] != "Z":
                return True
    return False


class Bench:
    """The outside of the controller: inputs, encoders, tool changer, and a recorder of the pins."""

    def __init__(self, hal, settings):
        self.hal = hal
        self.settings = settings
        self.component = hal.component("gaugeblock")
        self.component.ready()
        self.streams = []
        for number, types in enumerate(settings["samplers"]):
            self.streams.append(hal.stream(self.component, 0x48534130 + number, types))
        self.names = settings["pins"]
        self.values = None
        self.at_first = None
        self.changes = []
        self.asked = {}
        self.inputs = []
        self.begun = None
        self.first_sample = None
        self.newest = 0

    def set(self, pin, value):
        self.hal.set_p(pin, str(value))

    def prepare(self, inputs):
        self.rest()
        self.inputs = sorted(inputs, key=lambda change: change[0])
        self.change_inputs(0.0)

    def begin(self):
        self.record()
        self.changes = []
        if self.at_first is None:
            self.at_first = self.values

    def is_as_new(self):
        """Whether the pins are as they were before the first run."""
        return self.values == self.at_first

    def rest(self):
        for pin, value in self.settings["resting"]:
            self.set(pin, value)
        self.inputs = []
        self.begun = None

    def start(self):
        self.begun = time.monotonic()
        self.first_sample = None

    def change_inputs(self, now):
        while self.inputs and self.inputs[0][0] <= now:
            _, pin, value = self.inputs.pop(0)
            self.set(pin, value)

    def record(self):
        """Takes what the samplers have taken, cycle by cycle."""
        if not self.streams:
            return
        for _ in range(min(stream.depth for stream in self.streams)):
            parts = [stream.read() for stream in self.streams]
            if any(part is None for part in parts):
                break
            number = self.newest = self.streams[0].sampleno
            if self.first_sample is None:
                self.first_sample = number
            values = [value for part in parts for value in part]
            if self.values is not None and values != self.values:
                when = (number - self.first_sample) * self.settings["period"]
                for name, old, new in zip(self.names, self.values, values):
                    if old != new:
                        self.changes.append([round(when, 6), name, float(new)])
            self.values = values

    def poll(self):
        self.record()
        if self.begun is not None:
            self.change_inputs(time.monotonic() - self.begun)
        for asked, answer, value, seconds, resting in self.settings["answers"]:
            wanted = bool(self.hal.get_value(asked))
            if not wanted:
                if self.asked.pop(asked, None) is not None:
                    self.set(answer, resting)
                continue
            since = self.asked.setdefault(asked, time.monotonic())
            if since >= 0 and seconds is not None and time.monotonic() - since >= seconds:
                self.set(answer, value)
                self.asked[asked] = -1.0


class Gates:
    """User-defined codes that wait before blocks at which the operator acts: each reads a line before it ends."""

    def __init__(self, pipe, marks):
        self.pipe = pipe
        self.marks = marks
        self.close({})

    def reached(self, seen):
        return sum(len(seen.get(mark, [])) for mark in self.marks)

    def close(self, seen):
        """Takes back what no code has read; those that wait have been ended."""
        self.passed = self.reached(seen)
        try:
            while os.read(self.pipe, 4096):
                pass
        except BlockingIOError:
            pass

    def let_pass(self, seen):
        """What was to happen before the codes that wait has happened."""
        waiting = self.reached(seen) - self.passed
        os.write(self.pipe, b"\n" * waiting)
        self.passed += waiting


class Driver:
    """The controller's commands, its state and its messages."""

    def __init__(self, settings):
        import hal
        import linuxcnc

        linuxcnc.nmlfile = os.path.abspath("channels.nml")
        self.linuxcnc = linuxcnc
        self.command = linuxcnc.command()
        self.stat = linuxcnc.stat()
        self.errors = linuxcnc.error_channel()
        self.settings = settings
        self.bench = Bench(hal, settings)
        self.seen, self.executed = {}, 0
        self.begun = 0.0
        self.events = []
        self.checkpoint = []
        self.first, self.steps, self.turns, self.turns_until = "", 0, 1, 1
        os.mkfifo("gate")
        # For reading too, so that neither side waits for the other to open it.
        self.gates = Gates(os.open("gate", os.O_RDWR | os.O_NONBLOCK), [])
        self.reads_ahead = False
        self.pace = 1.0
        self.looked = 0.0
        self.is_behind = False
        self.prepared_at_first = None
        self.mode_told = None
        self.complaints = 0
        self.stands_at = (None, 0.0)
        self.motion_waits = (
            linuxcnc.EXEC_WAITING_FOR_MOTION,
            linuxcnc.EXEC_WAITING_FOR_MOTION_QUEUE,
            linuxcnc.EXEC_WAITING_FOR_MOTION_AND_IO,
        )
        self.modes = {linuxcnc.MODE_AUTO: "auto", linuxcnc.MODE_MDI: "mdi", linuxcnc.MODE_MANUAL: "manual"}

    # Waiting.

    def poll(self):
        self.stat.poll()
        self.bench.poll()
        if time.monotonic() - self.looked > 0.2:
            self.looked = time.monotonic()
            if not is_running("milltask"):
                report(failed="the task controller is gone")
                os._exit(1)
        # A program without end fills the channel faster than it is emptied.
        self.is_behind = True
        for _ in range(100):
            message = self.errors.poll()
            if not message:
                self.is_behind = False
                break
            kind, text = message
            if text.startswith(self.settings["marker"]):
                self.seen.setdefault(text, []).append(time.monotonic())
                self.executed += text[len(self.settings["marker"])] not in "+<>"
            else:
                if REALTIME_DELAY in text:
                    continue
                error = kind in (self.linuxcnc.NML_ERROR, self.linuxcnc.OPERATOR_ERROR)
                self.complaints += error
                report(message=text, error=error)
        mode = self.modes.get(self.stat.task_mode)
        if self.mode_told is not None and mode != self.mode_told:
            self.mode_told = mode
            report(mode=mode)

    def is_idle(self):
        stat, linuxcnc = self.stat, self.linuxcnc
        return (
            stat.interp_state == linuxcnc.INTERP_IDLE
            and stat.exec_state in (linuxcnc.EXEC_DONE, linuxcnc.EXEC_ERROR)
            and stat.state != linuxcnc.RCS_EXEC
            and stat.queue == 0
            and stat.inpos
            and stat.queued_mdi_commands == 0
            and not self.is_behind
        )

    def waits_for_motion(self):
        """Whether a motion has been queued and does not move."""
        stat = self.stat
        return (
            stat.exec_state in self.motion_waits
            and stat.queue > 0
            and stat.current_vel == 0.0
            and stat.delay_left <= 0.0
        )

    def is_held(self):
        """Whether a motion waits, and nothing that is known to come lets it go on."""
        stat = self.stat
        stands = self.waits_for_motion() and not self.bench.inputs
        place = (stat.motion_id, stat.actual_position, stat.distance_to_go) if stands else None
        if place is None or place != self.stands_at[0]:
            self.stands_at = (place, time.monotonic())
        return place is not None and time.monotonic() - self.stands_at[1] > STILL

    def is_paused(self):
        return self.stat.interp_state == self.linuxcnc.INTERP_PAUSED or self.stat.paused

    def wait(self, holds, seconds):
        """Whether it came to hold in time."""
        deadline = time.monotonic() + seconds
        while True:
            self.poll()
            if holds():
                return True
            if time.monotonic() > deadline:
                return False
            time.sleep(PAUSE)

    def done(self, seconds=10.0):
        serial = self.command.serial
        return self.wait(
            lambda: self.stat.echo_serial_number == serial and self.stat.state != self.linuxcnc.RCS_EXEC, seconds
        )

    def taken(self):
        """Until the last command has been taken; one that starts a program is done only when that ends or pauses."""
        serial = self.command.serial
        self.wait(lambda: self.stat.echo_serial_number == serial, 5.0)

    def sample(self):
        """Until the samples have what was set last, counted in cycles: on a busy machine they come late."""
        self.poll()
        if not self.bench.streams:
            self.wait(lambda: False, CYCLES * self.settings["period"])
            return
        last = self.bench.newest + CYCLES
        self.wait(lambda: self.bench.newest >= last, 5.0)

    # Before a run.

    def power_on(self):
        linuxcnc = self.linuxcnc
        for state in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
            self.command.state(state)
            self.done()
        self.poll()
        return self.stat.task_state == linuxcnc.STATE_ON

    def warm_up(self):
        """Moves to and fro: an abort brings back the modes of the last motion, whichever program it was in."""
        self.mode(self.linuxcnc.MODE_MDI)
        for block in ("G53 G0 X1", "G53 G0 X0"):
            self.command.mdi(block)
            self.done()
            self.wait(self.is_idle, 5.0)

    def mode(self, mode):
        self.poll()
        if self.stat.task_mode != mode:
            self.command.mode(mode)
            self.done()
        self.poll()
        return self.stat.task_mode == mode

    def reset(self, order):
        command, stat = self.command, self.stat
        self.poll()
        if order["load_tools"]:
            command.load_tool_table()
            self.done()
            # What the program before stored is stored once more now.
            command.reset_interpreter()
            self.done()
        if not stat.feed_override_enabled:
            command.set_feed_override(1)
        if abs(stat.feedrate - order["feed_override"]) > 1e-9:
            command.feedrate(order["feed_override"])
        if abs(stat.rapidrate - 1.0) > 1e-9:
            command.rapidrate(1.0)
        for number in range(stat.spindles):
            spindle = stat.spindle[number]
            if not spindle["override_enabled"]:
                command.set_spindle_override(1, number)
            if abs(spindle["override"] - 1.0) > 1e-9:
                command.spindleoverride(1.0, number)
        if stat.adaptive_feed_enabled:
            command.set_adaptive_feed(0)
        if not stat.feed_hold_enabled:
            command.set_feed_hold(1)
        shutil.copyfile("parameters.new", "memory/parameters.var")
        command.reset_interpreter()
        self.done()
        if order["block_delete"] is not None:
            # A reset switches it on, whatever the state says.
            command.set_block_delete(order["block_delete"])
            self.done()
        if order["optional_stop"] is not None:
            command.set_optional_stop(order["optional_stop"])
            self.done()

    # A run.

    def run_file(self, name):
        self.mode(self.linuxcnc.MODE_AUTO)
        self.command.program_open(os.path.abspath(name))
        self.done()
        self.bench.start()
        self.begun = time.monotonic()
        self.command.auto(self.linuxcnc.AUTO_RUN, 0)

    def run_by_hand(self, lines, seconds):
        """Enters line by line; an error ends it."""
        self.mode(self.linuxcnc.MODE_MDI)
        self.bench.start()
        self.begun = time.monotonic()
        was_paused = False
        for line in lines:
            # A pause by hand stays in the state, while blocks can be entered as before.
            was_paused = self.is_paused()
            self.command.mdi(line)
            if not self.entered(seconds):
                return "late"
            if self.stat.state == self.linuxcnc.RCS_ERROR:
                break
        return "paused" if self.is_paused() and not was_paused else "idle"

    def entered(self, seconds):
        """Whether the block that was entered last is over in time; meanwhile the operator acts."""
        serial = self.command.serial

        def is_over():
            if any(self.due(event) for event in self.events):
                return True
            self.let_pass()
            is_done = self.stat.echo_serial_number >= serial and self.stat.state != self.linuxcnc.RCS_EXEC
            return is_done and (self.is_idle() or self.is_paused())

        while self.wait(is_over, seconds):
            ready = next((event for event in self.events if self.due(event)), None)
            if ready is None:
                return True
            self.events.remove(ready)
            self.act(ready)
        return False

    def enter(self, event):
        """Enters a block in MDI mode while nothing runs, and shows what is in force before and after it."""

        def show():
            for line in self.checkpoint:
                self.command.mdi(line)
                self.done()

        report(entry="begins", line=event["line"], text=event["value"])
        show()
        report(entry="is entered")
        self.command.mdi(event["value"])
        self.done()
        self.wait(self.is_idle, 5.0)
        report(entry="is over")
        show()

    def due(self, event):
        """Whether the block of an event has begun as often as it says, and its offset has passed."""
        seen = self.seen.get(event["marker"], [])
        if len(seen) < event["execution"]:
            return False
        return time.monotonic() >= seen[event["execution"] - 1] + event["offset"]

    def let_pass(self):
        """Lets the codes end that wait before blocks, once all has been read that can be."""
        if self.gates.reached(self.seen) > self.gates.passed:
            self.read_ahead()
            self.gates.let_pass(self.seen)

    def read_ahead(self):
        """Until the interpreter has read all that it can: it reads between any two commands of ours."""
        place, same = None, 0
        for _ in range(200 if self.reads_ahead else 0):
            self.command.rapidrate(self.stat.rapidrate)
            self.taken()
            last, place = place, (self.stat.read_line, self.stat.call_level, self.stat.interp_state)
            same = same + 1 if place == last else 0
            if same == 3:
                break

    def act(self, event):
        linuxcnc, command = self.linuxcnc, self.command
        name, value = event["action"], event.get("value")
        report(operator=name, value=value)
        # On a busy machine the change of the mode may take longer than the operator waits.
        if name == "mdi" and self.stat.task_mode == linuxcnc.MODE_MDI and self.wait(self.is_idle, 0.5):
            self.enter(event)
            return
        complaints = self.complaints
        held_moves = self.stat.queue if self.waits_for_motion() else 0
        if name in ("cycle_start", "resume"):
            self.wait(lambda: self.is_paused() or self.is_idle(), 0.5)
        if name == "cycle_start":
            if self.is_idle():
                # As displays do it: a request to run is refused in any other mode.
                self.mode(linuxcnc.MODE_AUTO)
                self.turns_until += 1
                self.gates.close(self.seen)
                report(starts_again=True)
            command.auto(linuxcnc.AUTO_RUN, 0)
        elif name == "resume":
            command.auto(linuxcnc.AUTO_RESUME)
        elif name == "pause":
            command.auto(linuxcnc.AUTO_PAUSE)
        elif name == "abort":
            self.first = None
            if event["marker"] in self.gates.marks:
                self.read_ahead()
            command.abort()
            self.gates.close(self.seen)
        elif name == "mode":
            command.mode(next(mode for mode, word in self.modes.items() if word == value))
        elif name == "mdi":
            command.mdi(value)
        elif name == "optional_stop":
            command.set_optional_stop(value)
        elif name == "feed_override":
            command.feedrate(value * self.pace)
        elif name == "rapid_override":
            command.rapidrate(value)
        elif name == "spindle_override":
            command.spindleoverride(value, event["spindle"])
        elif name == "feed_hold":
            self.bench.set("motion.feed-hold", int(value))
            return
        self.taken()
        self.wait(lambda: self.complaints > complaints, 0.03)
        if self.complaints > complaints and name in REQUESTS:
            report(request_refused=name, held_moves=held_moves)

    def follow(self, seconds):
        """Until the run has ended or is paused, and no event can come any more."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            self.poll()
            ready = next((event for event in self.events if self.due(event)), None)
            if ready is not None:
                self.events.remove(ready)
                self.act(ready)
                continue
            self.let_pass()
            begun = len(self.seen.get(self.first, []))
            if self.events:
                self.turns_until = begun + self.turns
            elif begun > self.turns_until and not self.is_idle():
                return "endless"
            if self.executed > self.steps:
                return "budget"
            pending = [event for event in self.events if len(self.seen.get(event["marker"], [])) >= event["execution"]]
            if not pending and (self.is_idle() or self.is_paused()):
                return "paused" if self.is_paused() and not self.is_idle() else "idle"
            if not self.events and self.is_held():
                return "held"
            time.sleep(PAUSE)
        return "late"

    def run(self, order):
        self.settings["marker"] = order["marker"]
        self.seen, self.executed = {}, 0
        self.events = order["events"]
        self.checkpoint = order["checkpoint"]
        self.first, self.steps, self.turns = order["first"], order["steps"], order["turns"]
        self.turns_until = self.turns
        self.gates = Gates(self.gates.pipe, order["gates"])
        self.reads_ahead = order["reads_ahead"]
        self.pace = order["feed_override"]
        self.mode_told = None
        self.reset(order)
        self.bench.prepare(order["inputs"])
        self.sample()
        self.bench.begin()
        self.mode(self.linuxcnc.MODE_AUTO if order["by_hand"] is None else self.linuxcnc.MODE_MDI)
        self.mode_told = self.modes.get(self.stat.task_mode)
        if self.prepared_at_first is None:
            self.prepared_at_first = self.stat.pocket_prepped
        as_new = self.bench.is_as_new() and self.stat.pocket_prepped == self.prepared_at_first
        report(begins=True, mode=self.mode_told, as_new=as_new)
        if order["by_hand"] is not None:
            ending = self.run_by_hand(order["by_hand"], order["seconds"])
        else:
            self.run_file(order["program"])
            self.taken()
            ending = self.follow(order["seconds"])
        self.sample()
        self.mode_told = None
        report(ends=ending, pins=self.bench.changes, queued_moves=self.stat.queue, motion=self.stat.motion_type)
        if ending == "late":
            return False
        if not self.is_idle():
            self.command.abort()
            self.done()
        self.bench.rest()
        if self.stat.feedrate == 0.0:
            self.command.feedrate(1.0)
        if order["by_hand"] is not None and self.is_idle():
            # What the last block by hand set is not in the file yet. M66 writes it; it also reads modes back.
            for line in self.checkpoint:
                self.command.mdi(line)
                self.done()
            self.command.mdi("M66 P0 L0")
            self.done()
        shutil.copyfile("memory/parameters.var", "parameters.end")
        self.run_file(order["after"])
        if not self.done() or not self.wait(self.is_idle, 10.0):
            return False
        report(done=True)
        return True


def main():
    with open("driver.json", encoding="utf-8") as file:
        settings = json.load(file)
    driver = Driver(settings)
    if not driver.power_on():
        report(failed="the machine cannot be switched on")
        return
    driver.warm_up()
    report(ready=True)
    for line in sys.stdin:
        if not driver.run(json.loads(line)):
            report(failed="no end in time", late=True)
            return


if len(sys.argv) > 2 and sys.argv[1] == "guard":
    guard(sys.argv[2:])
else:
    main()
