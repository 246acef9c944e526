#!/usr/bin/env python3
"""LinuxCNC's stand-alone interpreter `rs274` behind the adapter protocol, grown from template.py: from `for request` on it is the template's.

It shows what the program prints, and looks no further: canonical calls and messages in order, the settings that calls switch, how the run
ended, the numbered parameters at the end. It shows no blocks, so that `blocks` is false, and no place of a fault. What rs274 only pretends to do
(pauses, inputs, user-defined codes) is unsupported. `certify rs274 --as "exec:python3 rs274.py"` holds the adapter that is built in to the same.
"""
import contextlib
import fcntl
import functools
import json
import os
import re
import subprocess
import sys
import tempfile

EFFECTS = [
    "straight_traverse", "straight_feed", "arc_feed", "straight_probe", "rigid_tap", "dwell", "prepare_tool", "change_tool", "set_tool_number",
    "orient_spindle", "wait_orient", "set_digital_output", "set_analog_output", "stop", "pallet_shuttle", "message", "log_open", "log_close",
    "stop_spindle_synchronisation", "program_end"]
SETTINGS = [
    "units", "work_offset", "rotation", "mist", "flood", "feed_override", "speed_override", "adaptive_feed", "feed_stop", "path", "spindle",
    "spindle_mode"]
DECLARATION = {
    "protocol": 1, "name": "rs274", "version": "by its printed calls", "languages": ["rs274"], "units": ["mm", "inch"],
    "features": ["another-bench", "block-delete", "fanuc-subs-off", "files", "ini", "io-counts", "orient-offset", "parameters", "spindles",
                 "tool-change-settings", "tools"],
    "observables": {
        "fields": SETTINGS, "fields_at_effects": SETTINGS, "effects": EFFECTS, "moves_in_place": True, "fault_kinds": False,
        "final_parameters": True, "hidden_parameters": [[5061, 5070], [5161, 5219], [5221, 5390], [5400, 5428]], "pins": [],
        "blocks": False, "fault_blocks": False},
    "resolution": 0.0001, "clock": "virtual", "edition": "linuxcnc-2.9", "observed": "rs274-2.9-observed"}

LAST_PARAMETER = 5601
SECONDS, BYTES = 5, 16 << 20
CALL = re.compile(r" *(\d+) N[\d.]*\s*([A-Z0-9_.]+)\((.*)\)")
AXES = "xyzabcuvw"
SWITCHES = {"MIST": "mist", "FLOOD": "flood"}
OVERRIDES = {"FEED_OVERRIDE": "feed_override", "ADAPTIVE_FEED": "adaptive_feed", "FEED_HOLD": "feed_stop"}
TURNS = {"START_SPINDLE_CLOCKWISE": "clockwise", "START_SPINDLE_COUNTERCLOCKWISE": "counterclockwise", "STOP_SPINDLE_TURNING": "stopped"}
PATHS = {"CANON_EXACT_PATH": "exact_path", "CANON_EXACT_STOP": "exact_stop", "CANON_CONTINUOUS": "continuous"}
PLANES = {"CANON_PLANE_XY": "xyz", "CANON_PLANE_YZ": "yzx", "CANON_PLANE_XZ": "zxy"}
DIRECTIONS = ["shortest", "clockwise", "counterclockwise"]
SILENT = {
    "SET_FEED_REFERENCE", "ON_RESET", "START_CHANGE", "RELOAD_TOOLDATA", "TURN_PROBE_ON", "TURN_PROBE_OFF", "SET_G92_OFFSET", "COMMENT",
    "USE_TOOL_LENGTH_OFFSET", "SET_NAIVECAM_TOLERANCE", "SET_FEED_MODE", "SET_FEED_RATE", "SET_SPINDLE_SPEED", "START_SPEED_FEED_SYNC",
    "NURBS_FEED", "SET_TOOL_TABLE_ENTRY"}


class Unsupported(Exception):
    """The controller does not have what the scenario needs."""


class Canon:
    """Printed calls become settings and effects."""

    def __init__(self, tools):
        self.events, self.end, self.tools = [], None, tools
        self.point, self.plane = dict.fromkeys(AXES, 0.0), "xyz"

    def do(self, effect, **arguments):
        self.events.append({"do": {"effect": effect, **arguments}})

    def set(self, **settings):
        self.events.append({"set": settings})

    def to(self, numbers, axes="xyzabc"):
        self.point = {**self.point, **dict(zip(axes, numbers))}
        return self.point

    def tool(self, place):
        return self.tools[place - 1]["number"] if place else 0

    def call(self, name, arguments):
        words = [word for word in re.split("[, ]+", arguments) if word]
        numbers = [float(word) for word in words if re.fullmatch(r"[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?|[-+]?(inf|nan)", word)]
        text = arguments[1:-1] if arguments[:1] == '"' else arguments
        first = int(numbers[0]) if numbers else 0
        if name in ("STRAIGHT_TRAVERSE", "STRAIGHT_FEED"):
            self.do(name.lower(), end=self.to(numbers))
        elif name == "STRAIGHT_PROBE":  # its probe touches at the end of every move
            end = self.to(numbers)
            self.do("straight_probe", end=end, contact=end)
        elif name == "ARC_FEED":
            one, other, centre, other_centre, turns, along, *rotary = numbers
            end = self.to([one, other, along, *rotary], self.plane + "abc")
            self.do("arc_feed", end=end, first_centre=centre, second_centre=other_centre, turns=int(turns))
        elif name == "RIGID_TAP":
            self.do("rigid_tap", end=self.to(numbers))
        elif name == "DWELL":
            self.do("dwell", seconds=numbers[0])
        elif name == "SELECT_TOOL":
            self.do("prepare_tool", tool=first)
        elif name in ("CHANGE_TOOL", "CHANGE_TOOL_NUMBER"):
            self.do("change_tool" if name == "CHANGE_TOOL" else "set_tool_number", tool=self.tool(first))
        elif name == "ORIENT_SPINDLE":
            self.set(spindle={str(first): "oriented"})
            self.do("orient_spindle", spindle=first, angle=numbers[1], direction=DIRECTIONS[int(numbers[2])])
        elif name.endswith("WAIT_ORIENT_COMPLETE"):
            self.do("wait_orient", spindle=int(name.split(".")[1]), timeout=numbers[0])
        elif re.fullmatch("(SET|CLEAR)_(MOTION|AUX)_OUTPUT_(BIT|VALUE)", name):
            timing = "with_motion" if "MOTION" in name else "at_once"
            if name.endswith("BIT"):
                self.do("set_digital_output", output=first, on=name.startswith("SET"), timing=timing)
            else:
                self.do("set_analog_output", output=first, to=numbers[1], timing=timing)
        elif name in ("PROGRAM_STOP", "OPTIONAL_PROGRAM_STOP"):
            self.do("stop", optional=name.startswith("OPTIONAL"))
        elif name == "PALLET_SHUTTLE":
            self.do("pallet_shuttle")
        elif name in ("MESSAGE", "LOG"):
            self.do("message", channel="log" if name == "LOG" else "display", text=text)
        elif name in ("LOGOPEN", "LOGAPPEND"):
            self.do("log_open", file=text, append=name == "LOGAPPEND")
        elif name == "LOGCLOSE":
            self.do("log_close")
        elif name == "STOP_SPEED_FEED_SYNCH":
            self.do("stop_spindle_synchronisation")
        elif name == "PROGRAM_END":
            # M30 exchanges pallets when everything is reset.
            shuttle = self.events.pop() if self.events and self.events[-1].get("do", {}).get("effect") == "pallet_shuttle" else None
            self.events += [shuttle] if shuttle else []
            self.do("program_end")
            self.end = "program_end"
        elif name == "FINISH":
            self.end = "percent_end"
        else:
            self.setting(name, words, numbers, first)

    def setting(self, name, words, numbers, first):
        switch, _, rest = name.partition("_")
        if name == "USE_LENGTH_UNITS":
            self.set(units={"CANON_UNITS_INCHES": "inch", "CANON_UNITS_MM": "mm"}[words[0]])
        elif name == "SELECT_PLANE":
            self.plane = PLANES.get(words[0], "xyz")
        elif name == "SET_G5X_OFFSET":
            self.set(work_offset=first)
        elif name == "SET_XY_ROTATION":
            self.set(rotation=numbers[0])
        elif name == "SET_MOTION_CONTROL_MODE":
            self.set(path=PATHS[words[0]])
        elif name == "SET_SPINDLE_MODE":
            self.set(spindle_mode={str(first): "surface_speed" if numbers[1] > 0 else "rpm"})
        elif name in TURNS:
            self.set(spindle={str(first): TURNS[name]})
        elif rest in ("ON", "OFF") and switch in SWITCHES:
            self.set(**{SWITCHES[switch]: rest.lower()})
        elif switch in ("ENABLE", "DISABLE") and rest == "SPEED_OVERRIDE":
            self.set(speed_override={str(first): "on" if switch == "ENABLE" else "off"})
        elif switch in ("ENABLE", "DISABLE") and rest in OVERRIDES:
            self.set(**{OVERRIDES[rest]: "on" if switch == "ENABLE" else "off"})
        elif name not in SILENT and "CUTTER_RADIUS_COMPENSATION" not in name:
            raise ValueError(f"unknown call {name}")


def compact(line):
    """Without blanks, in lower case: how the interpreter reads a line."""
    return "".join(line.split()).lower()


def code(line):
    """The same without comments."""
    return compact(re.sub(r"\([^)]*\)?|;.*", "", line))


def m_codes(line):
    return [int(number) for number in re.findall(r"m(\d+)", re.sub("<[^>]*>?", "", code(line)))]


def linear(number):
    """Whether a parameter is a stored length: of G28, G30, G92, or of a coordinate system."""
    starts = [5161, 5181, 5211] + list(range(5221, 5390, 20))
    return any(number - start in (0, 1, 2, 6, 7, 8) for start in starts)


def check(scenario):
    """Refuses what would reach beyond the program's files, and what rs274 only pretends to do."""
    program, machine = scenario["program"], scenario.get("machine", {})
    files = program.get("files", {})
    lines = "\n".join([program["main"], *files.values()]).split("\n")
    own_bench = scenario.get("bench", {}).get("name") == "stand-alone rs274"
    for name in files:
        if not re.fullmatch(r"(elsewhere/)?[^./][^/]*", name) or name in ("main.ngc", "machine.ini", "tools.tbl", "parameters.var"):
            raise Unsupported(f"{name!r} is no file name for a sub")
    stores = []
    for line in lines:
        text = compact(line)
        if "(py" in text or ";py" in text or re.search(r"o<[^>]*[/\\]", text):
            raise Unsupported("it would reach beyond the program's files")
        shown = re.search(r"\(\s*(debug|print|log|abort)\s*,([^()]*)\)[^()]*$", line, re.I)
        if shown and re.search(r"#(<[^>]*)?$", shown[2]):
            raise Unsupported("a message that ends within a name shows what lies in memory")
        pauses = [number for number in m_codes(line) if number in (0, 1, 2, 30, 60)]
        if not own_bench and pauses in ([0], [60]):
            raise Unsupported("its pauses do not pause")
        if machine.get("length_unit", "mm") != "inch":
            stores += [int(number) for number in re.findall(r"#(\d+)=", text) if linear(int(number))]
            stores += [int(number) for number in re.findall(r"#(\d+)", text) if linear(int(number)) and stored(lines)]
    stored_numbers = [int(number) for number in machine.get("parameters", {})]
    lengths = machine.get("tools") or [number for number in stored_numbers if 5161 <= number <= 5390 and number != 5220]
    if machine.get("length_unit", "mm") != "inch" and (lengths or stores):
        raise Unsupported("it keeps stored lengths in inches")
    if [number for number in stored_numbers if not 1 <= number <= LAST_PARAMETER]:
        raise Unsupported("a parameter that cannot be stored")
    if ends_endlessly(program["main"], program.get("block_delete", False)):
        raise Unsupported("M99 in the main program ends it")
    name = scenario.get("bench", {}).get("name")
    if name not in (None, "stand-alone rs274"):
        raise Unsupported("the outside always answers in the same way")
    return lines


def ends_endlessly(text, block_delete):
    """Whether M99 may end the main program: it stands not in a sub, nor behind the program's end, nor in a numbered program below, which begins
    with nothing but its number."""
    blocks = [code(line) for line in text.split("\n") if code(line)]
    in_sub = branches = False
    for place, block in enumerate(blocks):
        if place and re.fullmatch(r"o\d+", block):
            return False
        in_sub = (in_sub or re.fullmatch(r"o(\d+|<[^>]*>)sub", block) is not None) and "endsub" not in block
        branches = branches or re.match(r"o(\d+|<[^>]*>)(if|while|do|repeat)", block) is not None
        is_deleted = block_delete and block.startswith("/")
        if not in_sub and not branches and not is_deleted and {2, 30} & set(m_codes(block)):
            return False
        if 99 in m_codes(block) and not in_sub:
            return True
    return False


def stored(lines):
    return any(re.search(r"g(10|28\.1|30\.1|52|92)(?![\d.])", code(line)) for line in lines)


@contextlib.contextmanager
def hal(lines):
    """Whether the program names HAL, whose memory is one for the whole machine: it has it to itself. Others do without."""
    names = any("_hal[" in text or "hal_pin_vars" in text for text in map(compact, lines))
    with contextlib.ExitStack() as held:
        if names:
            file = held.enter_context(open(os.path.join(tempfile.gettempdir(), "gaugeblock-hal.lock"), "a"))
            fcntl.flock(file, fcntl.LOCK_EX)
        yield names


def number(value):
    return int(value) if float(value).is_integer() and abs(value) < 1e15 else value


def write(folder, scenario, lines, has_hal):
    machine, program = scenario.get("machine", {}), scenario["program"]
    change = machine.get("tool_change", {})
    flag = lambda on: "1" if on else "0"
    ini = {"RS274NGC": [
        "SUBROUTINE_PATH=.", f"DISABLE_FANUC_STYLE_SUB={flag(not machine.get('fanuc_subs', True))}",
        f"ORIENT_OFFSET={number(machine.get('orient_offset', 0))}"] + ([] if has_hal else ["HAL_PIN_VARS=0"]),
        "TRAJ": [f"SPINDLES={machine.get('spindles', 1)}"],
        "EMCIO": [f"TOOL_CHANGE_{name.upper()}={flag(change.get(name))}" for name in ("at_g30", "quill_up", "with_spindle_on")]}
    for name, value in machine.get("ini", {}).items():
        section, name = re.fullmatch(r"\[([^]]*)\](.*)", name).groups()
        ini.setdefault(section, []).append(f"{name}={number(value)}")
    tools = [f"T{tool['number']} P{tool['pocket'] if tool.get('pocket') is not None else tool['number']}"
             + "".join(f" {axis.upper()}{tool.get('offset', {}).get(axis, 0)}" for axis in AXES)
             + f" D{tool.get('diameter', 0)} I{tool.get('front_angle', 0)} J{tool.get('back_angle', 0)} Q{tool.get('orientation', 0)}"
             for tool in machine.get("tools", [])]
    # Only what the file lists is written back.
    text = "\n".join(map(compact, lines))
    named = range(1, LAST_PARAMETER + 1) if re.search(r"#(?![\d<])", text) else [*range(1, 31), 5599, *map(int, re.findall(r"#(\d+)", text))]
    values = {number: 0 for number in named if 1 <= number <= LAST_PARAMETER}
    values.update({5220: 1, **{int(number): value for number, value in machine.get("parameters", {}).items()}})
    put = lambda name, content: open(os.path.join(folder, name), "w", newline="").write(content)
    put("machine.ini", "".join(f"[{section}]\n" + "".join(f"{line}\n" for line in ini[section]) for section in ini))
    put("tools.tbl", "\n" + "".join(f"{line}\n" for line in tools))
    put("parameters.var", "".join(f"{key}\t{number(value)}\n" for key, value in sorted(values.items())))
    for name, content in [("main.ngc", program["main"]), *program.get("files", {}).items()]:
        os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
        put(name, "".join(f"{line.rstrip(chr(13))}\n" for line in content.split("\n")[:-1 if content.endswith("\n") else None]))


@functools.cache
def at_start():
    """The settings that are in force before anything switches them, by the parameters that tell them."""
    switches = ["mist", "flood", "feed_override", "speed_override", "adaptive_feed", "feed_stop"]
    asked = " ".join("#<_feed_hold>" if name == "feed_stop" else f"#<_{name}>" for name in switches)
    events = outcome({"program": {"main": f"(print,{asked})\nm2\n"}}, {})["steps"][0]["events"]
    told = next(event["do"]["text"] for event in events if event.get("do", {}).get("channel") == "print")
    start = {name: "on" if float(value) else "off" for name, value in zip(switches, told.split())}
    return {**start, "speed_override": {"0": start["speed_override"]}}


def run(scenario):
    return outcome(scenario, at_start())


def outcome(scenario, start):
    """What rs274 did. Each run is a process of its own, so that `reset` has nothing to do."""
    lines = check(scenario)
    memory = "/dev/shm" if os.path.isdir("/dev/shm") and "TMPDIR" not in os.environ else None
    with hal(lines) as has_hal, tempfile.TemporaryDirectory(prefix="gaugeblock-rs274-", dir=memory) as folder:
        write(folder, scenario, lines, has_hal)
        command = ["rs274", "-g", "-i", "machine.ini", "-t", "tools.tbl", "-v", "parameters.var"]
        command += ["-b"] if scenario["program"].get("block_delete") else []
        clean = {"HOME": folder, "LC_ALL": "C", "PATH": os.environ["PATH"]}
        with open(os.path.join(folder, "printed"), "w+b") as printed:
            limit = f"ulimit -f {BYTES // 512}; exec \"$@\""
            try:
                done = subprocess.run(["/bin/sh", "-c", limit, "sh", *command, "main.ngc"], cwd=folder, env=clean, timeout=SECONDS,
                                      stdin=subprocess.DEVNULL, stdout=printed, stderr=subprocess.PIPE)
            except subprocess.TimeoutExpired:
                raise Unsupported("a program that does not end") from None
            if done.returncode == -25:  # more output than it may write
                raise Unsupported("a program that does not end")
            if done.returncode not in (0, 1):
                sys.exit(f"rs274 exited with {done.returncode}: {done.stderr.decode(errors='replace')[-300:]}")
            printed.seek(0)
            text = printed.read().decode(errors="replace")
        canon, due = Canon(scenario.get("machine", {}).get("tools", [])), 1
        for line in text.split("\n")[:-1]:
            call = CALL.fullmatch(line)
            if call and int(call[1]) == due:
                due += 1
                if call[2] != "FINISH" or done.returncode == 0:
                    canon.call(call[2], call[3])
            else:
                canon.do("message", channel="print", text=line)
            if canon.end:
                break
        with open(os.path.join(folder, "parameters.var")) as file:
            pairs = [line.split() for line in file if line.strip()]
    hidden = DECLARATION["observables"]["hidden_parameters"]
    parameters = {number: float(value) for number, value in pairs
                  if float(value) and not any(first <= int(number) <= last for first, last in hidden)}
    end = {"end": canon.end}
    if canon.end is None and done.returncode == 1:
        # Others leave entries in the memory of HAL, of which it complains.
        others = re.compile(r"executing|HAL: ERROR: .* component.*|\s*")
        said = [line for line in done.stderr.decode(errors="replace").split("\n") if not others.fullmatch(line)]
        end = {"end": "fault", "message": said[0] if said else ""}
    elif canon.end is None:
        sys.exit("a run without an end")
    if len(canon.events) > scenario.get("budget", {}).get("effects", 100000):
        raise Unsupported("a program that does not end")
    step = {"block": {"file": "main.ngc", "line": 1}, "events": canon.events}
    return {"language": "rs274", "start": start, "steps": [step], "end": end, "parameters": parameters}


for request in map(json.loads, sys.stdin):
    answer = {"hello": {"hello": DECLARATION}, "reset": {"done": {}}, "bye": {"done": {}}}.get(request["op"])
    try:
        answer = answer or ({"outcome": run(request["scenario"])} if request["op"] == "run" else {"refused": "unknown operation"})
    except Unsupported as why:
        answer = {"unsupported": str(why)}
    print(json.dumps({"id": request["id"], **answer}), flush=True)
    if request["op"] == "bye":
        break
