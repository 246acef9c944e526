"""An adapter for the library pygcode, which reads G-code and follows modes and position of a machine.

pip install pygcode==0.2.1
gaugeblock certify --controller "exec:python3 examples/libraries/pygcode_adapter.py"

The library reads each line; the adapter reports what its machine is then. Codes that the machine ignores (G10, G28,
G92, M6 …) and canned cycles, of which it follows the end alone, are not in the declared language. It knows no end of
a program: M2 changes no mode, so that the motion mode, which each M2 sets, is not reported.
"""
import json
import sys

from pygcode import Line, Machine
from pygcode.gcodes import GCodeEndProgram, GCodeEndProgramPalletShuttle, GCodeLinearMove, GCodeRapidMove
from pygcode.machine import Mode

AXES = "XYZ"
# Members of the library's modal groups, by the number of their word: the field, and its value by code.
MODES = {
    "units": ("units", {20: "inch", 21: "mm"}),
    "plane_selection": ("plane", {17: "xy", 18: "zx", 19: "yz"}),
    "distance": ("distance", {90: "absolute", 91: "incremental"}),
    "arc_ijk_distance": ("arc_distance", {90.1: "absolute", 91.1: "incremental"}),
    "feed_rate_mode": ("feed_mode", {93: "inverse_time", 94: "per_minute", 95: "per_revolution"}),
    "coordinate_system": ("work_offset", {54: 1, 55: 2, 56: 3, 57: 4, 58: 5, 59: 6, 59.1: 7, 59.2: 8, 59.3: 9}),
    "control_mode": ("path", {61: "exact_path", 61.1: "exact_stop", 64: "continuous"}),
}
SPINDLES = {3: "clockwise", 4: "counterclockwise", 5: "stopped"}
FIELDS = [field for field, _ in MODES.values()] + ["feed_rate", "spindle", "spindle_speed", "mist", "flood"]
DECLARATION = {
    "protocol": 1, "name": "pygcode", "version": "0.2.1", "languages": ["rs274"], "units": ["mm"], "features": [],
    "observables": {
        "fields": [*FIELDS, "position"], "fields_at_effects": FIELDS,
        "effects": ["straight_traverse", "straight_feed"],
        "moves_in_place": False, "fault_kinds": False, "final_parameters": False, "pins": []},
    "language": {
        "g": ["0", "1", "2", "3", "4", "17", "18", "19", "20", "21", "54", "55", "56", "57", "58", "59", "59.1", "59.2",
              "59.3", "61", "61.1", "64", "80", "90", "90.1", "91", "91.1", "93", "94", "95"],
        "m": ["2", "3", "4", "5", "7", "8", "9", "30"],
        "words": {code: AXES + "IJKRP" for code in ("G2", "G3")}, "axes": AXES, "letters": "FSN",
        "parameters": [], "expressions": False, "o_words": False, "comments": ["parentheses", "semicolon"]},
    "resolution": 0.0, "clock": "virtual", "edition": "linuxcnc-2.9",
    "options": {
        "modal-groups.initial-motion": "traverse", "motion.without-axis-words": "move-in-place",
        "units-planes.feed-over-unit-change": "kept", "program-end.feed-after-mode-change": "kept",
        "arcs.turns-below-one": "one", "arcs.zero-radius": "accepted", "arcs.offsets-alone": "arc",
        "text.comment-nested": "plain", "text.percent-alone": "ignored", "text.line-end-counted": "not-counted"}}


class Configured(Mode):
    """The modes at the start, which the library lets its user configure, as the manual has them."""
    default_mode = "G0 G17 G90 G91.1 G94 G21 G40 G49 G54 G64 G97 M5 M9 F0 S0 T0"


class Observed(Machine):
    """The library's machine, which notes its straight moves."""
    MODE_CLASS = Configured
    axes = set(AXES)
    events = ()

    def move_to(self, rapid=False, **coords):
        super().move_to(rapid=rapid, **coords)
        effect = {GCodeRapidMove: "straight_traverse", GCodeLinearMove: "straight_feed"}.get(type(self.mode.motion))
        if effect:
            self.note_settings()
            self.events.append({"do": {"effect": effect, "end": self.point()}})

    def note_settings(self):
        before, self.known = self.known, self.settings()
        changed = {field: value for field, value in self.known.items() if before[field] != value}
        if changed:
            self.events.append({"set": changed})

    def settings(self):
        mode = self.mode
        settings = {}
        for group, (field, values) in MODES.items():
            code = getattr(mode, group)
            if code is not None and code.word.value in values:
                settings[field] = values[code.word.value]
        settings["feed_rate"] = mode.feed_rate.word.value
        settings["spindle"] = {"0": SPINDLES[mode.spindle.word.value]}
        settings["spindle_speed"] = {"0": mode.spindle_speed.word.value}
        for field, code in (("mist", 7), ("flood", 8)):
            settings[field] = "on" if mode.coolant.word.value == code else "off"
        return settings

    def point(self):
        return {axis.lower(): self.pos.values[axis] for axis in AXES}


def run(program):
    machine, steps = Observed(), []
    machine.known = machine.settings()
    outcome = {"language": "rs274", "start": machine.known, "steps": steps}
    for number, text in enumerate(program.splitlines(), 1):
        block, machine.events = {"file": "main.ngc", "line": number}, []
        try:
            line = Line(text)
            machine.process_block(line.block)
        except Exception as error:  # The library has no common error; whatever it raises, it refuses the line.
            return {"outcome": {**outcome, "end": {"end": "fault", "block": block, "message": repr(error)}}}
        if not line.block.words:
            continue
        machine.note_settings()
        state = {"language": "rs274", "position": machine.point()}
        steps.append({"block": block, "events": machine.events, "state": state})
        if any(isinstance(code, (GCodeEndProgram, GCodeEndProgramPalletShuttle)) for code in line.gcodes):
            return {"outcome": {**outcome, "end": {"end": "program_end"}}}
    return {"unsupported": "the library reads lines; it does not know that a program has an end"}


for request in map(json.loads, sys.stdin):
    answer = {"hello": {"hello": DECLARATION}, "reset": {"done": {}}, "bye": {"done": {}}}.get(request["op"])
    if request["op"] == "run":
        answer = run(request["scenario"]["program"]["main"])
    print(json.dumps({"id": request["id"], **(answer or {"refused": "unknown operation"})}), flush=True)
    if request["op"] == "bye":
        break
