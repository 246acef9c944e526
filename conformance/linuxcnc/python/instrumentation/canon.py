"""Canonical calls as settings and effects of the vocabulary."""
import re

from . import state
from .inverse_time import rate_of_arc, rate_of_line
from .settings import AXES, Lengths, position, put
from .text import code, plain_word

SIX = "xyzabc"  # axes that a move has
PLANE_AXES = {"zx": "zxy", "yz": "yzx"}  # first, second and normal one, where they are not X, Y and Z
UNITS = {"CANON_UNITS_INCHES": "inch", "CANON_UNITS_MM": "mm"}
PLANES = {"CANON_PLANE_XY": "xy", "CANON_PLANE_YZ": "yz", "CANON_PLANE_XZ": "zx"}
PLANE_CODES = {"g17.1": "uv", "g18.1": "wu", "g19.1": "vw"}
PATHS = {"CANON_EXACT_PATH": "exact_path", "CANON_EXACT_STOP": "exact_stop", "CANON_CONTINUOUS": "continuous"}
TURNS = {"START_SPINDLE_CLOCKWISE": "clockwise", "START_SPINDLE_COUNTERCLOCKWISE": "counterclockwise", "STOP_SPINDLE_TURNING": "stopped"}
DIRECTIONS = ["shortest", "clockwise", "counterclockwise"]
SWITCHES = {
    "MIST_ON": {"mist": "on"}, "MIST_OFF": {"mist": "off"}, "FLOOD_ON": {"flood": "on"}, "FLOOD_OFF": {"flood": "off"},
    "ENABLE_FEED_OVERRIDE": {"feed_override": "on"}, "DISABLE_FEED_OVERRIDE": {"feed_override": "off"},
    "ENABLE_ADAPTIVE_FEED": {"adaptive_feed": "on"}, "DISABLE_ADAPTIVE_FEED": {"adaptive_feed": "off"},
    "ENABLE_FEED_HOLD": {"feed_stop": "on"}, "DISABLE_FEED_HOLD": {"feed_stop": "off"}}
# Modes that no call shows are told in comments. A comment of the program may say the same; the checkpoint after the block puts that right.
COMMENTS = {
    "distance mode changed to absolute": {"distance": "absolute"}, "distance mode changed to incremental": {"distance": "incremental"},
    "IJK distance mode changed to absolute": {"arc_distance": "absolute"},
    "IJK distance mode changed to incremental": {"arc_distance": "incremental"},
    "feed mode set to inverse time": {"feed_mode": "inverse_time"}, "feed mode set to units per minute": {"feed_mode": "per_minute"},
    "feed mode set to units per revolution": {"feed_mode": "per_revolution"},
    "retract mode set to old_z": {"retract": "old_z"}, "retract mode set to r_plane": {"retract": "r_plane"},
    "Lathe diameter mode changed to diameter": {"lathe": "diameter"}, "Lathe diameter mode changed to radius": {"lathe": "radius"},
    "cutter radius compensation off": {"compensation": "off"}, "cutter radius compensation on left": {"compensation": "left"},
    "cutter radius compensation on right": {"compensation": "right"}}
OUTPUTS = {
    "SET_MOTION_OUTPUT_BIT": (True, "with_motion"), "CLEAR_MOTION_OUTPUT_BIT": (False, "with_motion"),
    "SET_AUX_OUTPUT_BIT": (True, "at_once"), "CLEAR_AUX_OUTPUT_BIT": (False, "at_once")}
SILENT = {
    "SET_FEED_REFERENCE", "ON_RESET", "START_CHANGE", "RELOAD_TOOLDATA", "TURN_PROBE_ON", "TURN_PROBE_OFF", "SET_TOOL_TABLE_ENTRY",
    "START_CUTTER_RADIUS_COMPENSATION", "STOP_CUTTER_RADIUS_COMPENSATION", "SET_CUTTER_RADIUS_COMPENSATION"}
NO_LIMIT = 1e29  # a speed limit that stands for none


class Canon:
    """What the calls so far have set, and the events since it was last asked."""

    def __init__(self, tools):
        self.now, self.events, self.lengths = {}, [], Lengths()
        self.point, self.tool, self.tools = {}, 0, tools
        self.speed = None  # of the next move under inverse time, which the calls show in place of F
        self.block = ""  # code of the block that is executed, for what the calls leave out

    def stands_before(self, line, checkpoint):
        """The block that comes next, and where it begins."""
        self.block, self.point = code(line), state.point(checkpoint)

    def take_events(self):
        """The events since the last time."""
        events, self.events, self.speed = self.events, [], None
        return events

    def settle(self, checkpoint):
        """Takes over what a checkpoint shows: modes, F with all its decimals, and where a spline ends, which no call does."""
        self.set(state.modes(checkpoint, self.now, self.block))
        self.lengths.precise_feed(checkpoint.numbers["_feed"])
        for event in self.events:
            if event.get("do", {}).get("effect") == "nurbs_feed":
                event["do"]["end"] = state.point(checkpoint)

    def program_end(self, checkpoint):
        """M2 or M30. What it resets without a call is reset before M30 exchanges pallets, as what it resets by calls is."""
        has_shuttle = self.events[-1:] == [{"do": {"effect": "pallet_shuttle"}}]
        shuttle = [self.events.pop()] if has_shuttle else []
        self.settle(checkpoint)
        self.events += shuttle
        self.do("program_end")

    def set(self, change=None, **settings):
        put(self.now, self.events, settings if change is None else change)

    def do(self, effect, **arguments):
        self.events.append({"do": {"effect": effect, **arguments}})

    def message(self, channel, text):
        self.do("message", channel=channel, text=text)

    def call(self, call):
        """Moves and the feed; what is none of these is handed on, and what nobody knows is an error."""
        match call.name, call.numbers():
            case ("STRAIGHT_TRAVERSE", to):
                self.do("straight_traverse", end=self.to(SIX, to))
            case ("STRAIGHT_FEED", to):
                self.feed_of_move(lambda: rate_of_line(self.speed, self.point, position(SIX, to)))
                self.do("straight_feed", end=self.to(SIX, to))
            case ("ARC_FEED", [one, other, centre, other_centre, turns, along, *rotary]):
                axes = PLANE_AXES.get(self.now.get("plane"), "xyz")
                self.feed_of_move(lambda: rate_of_arc(self.speed, [self.point.get(axis, 0.0) for axis in axes], [one, other, along],
                                                      [centre, other_centre], turns))
                end = self.to(axes + "abc", [one, other, along, *rotary])
                self.do("arc_feed", end=end, first_centre=centre, second_centre=other_centre, turns=int(turns))
            case ("STRAIGHT_PROBE", to):  # the probe of the stand-alone program touches at the end of every move
                end = self.to(SIX, to)
                self.do("straight_probe", end=end, contact=end)
            case ("RIGID_TAP", to):
                self.do("rigid_tap", end=self.to("xyz", to))
            case ("NURBS_FEED", [points, *_]):
                self.do("nurbs_feed", points=int(points), end=self.point)
            case ("DWELL", [seconds]):
                self.do("dwell", seconds=seconds)
            case ("SET_FEED_RATE", [rate]):
                if self.now.get("feed_mode") == "inverse_time" and rate > 0:
                    self.speed = rate
                else:
                    self.set(self.lengths.feed(rate, self.now.get("feed_mode")))
            case _:
                self.setting(call)

    def to(self, axes, numbers):
        reached = self.point | dict(zip(axes, numbers))
        self.point = position(reached, reached.values())
        return self.point

    def feed_of_move(self, had_back):
        """F under inverse time is set with the other words of its block, behind what a comment says; the first call that shows it is the one of the
        move. It is that of the block, or had back from the move where the block has no plain number."""
        if self.speed is None:
            return
        written = plain_word(self.block, "f")
        rate = had_back() if written is None else written
        if rate is not None:
            changed = []
            put(self.now, changed, self.lengths.feed(rate, "inverse_time"))
            said = ("message", "log_open", "log_close")
            place = next((place for place, event in enumerate(self.events) if event.get("do", {}).get("effect") not in said), len(self.events))
            self.events[place:place] = changed

    def setting(self, call):
        """Modes, offsets and the path."""
        match call.name, call.numbers():
            case ("USE_LENGTH_UNITS", _):
                unit = UNITS[call.words()[0]]
                self.set({"units": unit} | self.lengths.use_unit(unit))
            case ("SELECT_PLANE", _):
                # The call does not tell U, V and W planes from each other; the block does, or the checkpoint after it.
                by_code = next((plane for code, plane in PLANE_CODES.items() if code in self.block), self.now.get("plane"))
                self.set(plane=PLANES.get(call.words()[0], by_code))
            case ("SET_G5X_OFFSET", [index, *offset]):
                self.set({"work_offset": int(index)} | self.lengths.tell(g5x_offset=position(AXES, offset)))
            case ("SET_G92_OFFSET", offset):
                self.set(self.lengths.tell(g92_offset=position(AXES, offset)))
            case ("SET_XY_ROTATION", [angle]):
                self.set(rotation=angle)
            case ("USE_TOOL_LENGTH_OFFSET", offset):
                self.set(self.lengths.tell(tool_offset=position(AXES, offset)))
            case ("SET_MOTION_CONTROL_MODE", tolerance):
                path = PATHS[call.words()[0]]
                blend = self.lengths.tell(blend_tolerance=(tolerance or [0.0])[0]) if path == "continuous" else {}
                self.set({"path": path} | blend)
            case ("SET_NAIVECAM_TOLERANCE", [tolerance]):
                self.set(self.lengths.tell(naive_cam_tolerance=tolerance))
            case ("SET_FEED_MODE", [_, per_revolution]):  # comments tell inverse time from per minute
                self.set({"feed_mode": "per_revolution"} if per_revolution > 0 else {})
            case ("COMMENT", _):
                self.comment(call.text())
            case _:
                self.spindle(call)

    def comment(self, text):
        change = COMMENTS.get(text.removeprefix("interpreter: "), {}) if text.startswith("interpreter: ") else {}
        if change == {"feed_mode": "inverse_time"}:
            self.lengths.feed_is_no_length()
        if "compensation" in change:
            change = {"compensation": state.compensation(change["compensation"], self.now.get("compensation"), self.block)}
        self.set(change)

    def spindle(self, call):
        """Spindles and switches."""
        match call.name, call.numbers():
            case ("SET_SPINDLE_SPEED", [spindle, speed]):
                self.set(spindle_speed={str(int(spindle)): speed})
            case ("SET_SPINDLE_MODE", [spindle, limit]):
                index = str(int(spindle))
                self.set(spindle_mode={index: "surface_speed" if limit > 0 else "rpm"},
                         spindle_limit={index: {"rpm": limit} if 0 < limit <= NO_LIMIT else "none"})
            case (("START_SPINDLE_CLOCKWISE" | "START_SPINDLE_COUNTERCLOCKWISE" | "STOP_SPINDLE_TURNING") as name, [spindle]):
                self.set(spindle={str(int(spindle)): TURNS[name]})
            case (("ENABLE_SPEED_OVERRIDE" | "DISABLE_SPEED_OVERRIDE") as name, [spindle]):
                self.set(speed_override={str(int(spindle)): "on" if name.startswith("ENABLE") else "off"})
            case ("ORIENT_SPINDLE", [spindle, angle, direction]):
                self.set(spindle={str(int(spindle)): "oriented"})
                self.do("orient_spindle", spindle=int(spindle), angle=angle, direction=DIRECTIONS[int(direction)])
            case (name, [timeout]) if name.endswith("WAIT_ORIENT_COMPLETE"):
                self.do("wait_orient", spindle=int(name.split(".")[1]), timeout=timeout)
            case ("START_SPEED_FEED_SYNC", [pitch, _]):
                # The calls do not show which spindle a move follows; the block does, where it says so in a plain number.
                spindle = re.search(r"\$(.[0-9]*)", self.block)
                self.do("start_spindle_synchronisation", spindle=int(spindle[1]) if spindle else 0, pitch=pitch)
            case ("STOP_SPEED_FEED_SYNCH", _):
                self.do("stop_spindle_synchronisation")
            case (name, _) if name in SWITCHES:
                self.set(SWITCHES[name])
            case _:
                self.other(call)

    def other(self, call):
        """Messages, tools, stops and signals."""
        match call.name, call.numbers():
            case ("MESSAGE", _):
                self.message("display", call.text())
            case ("LOG", _):
                self.message("log", call.text())
            case (("LOGOPEN" | "LOGAPPEND") as name, _):
                self.do("log_open", file=call.text(), append=name == "LOGAPPEND")
            case ("LOGCLOSE", _):
                self.do("log_close")
            case ("SELECT_TOOL", [tool]):
                self.do("prepare_tool", tool=int(tool))
            case ("CHANGE_TOOL", [place]):
                self.tool = self.tool_at(int(place))
                self.do("change_tool", tool=self.tool)
            case ("CHANGE_TOOL_NUMBER", [place]):
                self.tool = self.tool_at(int(place))
                self.do("set_tool_number", tool=self.tool)
            case (("PROGRAM_STOP" | "OPTIONAL_PROGRAM_STOP") as name, _):
                self.do("stop", optional=name.startswith("OPTIONAL"))
            case ("PALLET_SHUTTLE", _):
                self.do("pallet_shuttle")
            case (name, [output]) if name in OUTPUTS:
                on, timing = OUTPUTS[name]
                self.do("set_digital_output", output=int(output), on=on, timing=timing)
            case (("SET_MOTION_OUTPUT_VALUE" | "SET_AUX_OUTPUT_VALUE") as name, [output, to]):
                self.do("set_analog_output", output=int(output), to=to, timing="with_motion" if "MOTION" in name else "at_once")
            case (name, _) if name not in SILENT:
                raise ValueError(f"unknown call {name}({call.arguments})")

    def tool_at(self, place):
        """The controller names tools by their place in the table."""
        return self.tools[place - 1]["number"] if place else 0
