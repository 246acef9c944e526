#!/usr/bin/env python3
"""LinuxCNC's stand-alone interpreter `rs274` behind the adapter protocol, grown from template.py: from `for request` on it is the template's, but for
the line that answers `shows`, which it offers.

It shows what the adapter that is built in shows, and gets its verdicts case by case: executed blocks with their effects, the settings at each effect,
the state after each block, faults with place and kind, the numbered parameters at the end. How, tells the folder `instrumentation` next to it. What rs274
only pretends to do (pauses, inputs, user-defined codes) is unsupported, and so is a program that does not end.
"""
import json
import sys

from instrumentation import support
from instrumentation.machine import hal
from instrumentation.outcome import outcome
from instrumentation.session import DecidedByLine, Session
from instrumentation.text import Source

SETTINGS = [
    "units", "plane", "distance", "arc_distance", "feed_mode", "feed_rate", "retract", "compensation", "tool_offset", "work_offset", "g5x_offset",
    "g92_offset", "rotation", "lathe", "path", "blend_tolerance", "naive_cam_tolerance", "spindle_speed", "spindle_mode", "spindle_limit", "spindle",
    "mist", "flood", "feed_override", "speed_override", "adaptive_feed", "feed_stop"]
STATE = ["motion", "position", "tool", "prepared_tool", "call_level", "parameter"]
EFFECTS = [
    "straight_traverse", "straight_feed", "arc_feed", "straight_probe", "nurbs_feed", "rigid_tap", "dwell", "prepare_tool", "change_tool",
    "set_tool_number", "orient_spindle", "wait_orient", "start_spindle_synchronisation", "stop_spindle_synchronisation", "set_digital_output",
    "set_analog_output", "stop", "pallet_shuttle", "message", "log_open", "log_close", "program_end"]
DECLARATION = {
    "protocol": 1, "name": "rs274", "version": "2.9 in Python", "languages": ["rs274"], "units": ["mm", "inch"],
    "features": ["another-environment", "block-delete", "fanuc-subs-off", "files", "ini", "io-counts", "orient-offset", "parameters", "spindles",
                 "tool-change-settings", "tools"],
    "observables": {
        "fields": SETTINGS + STATE, "fields_at_effects": SETTINGS, "effects": EFFECTS, "moves_in_place": True, "fault_kinds": True,
        "final_parameters": True, "hidden_parameters": [[5061, 5070], [5400, 5428]], "pins": []},
    # Calls have four decimals, and checkpoints show a value below a ten-thousandth as zero.
    "resolution": 0.0001, "clock": "virtual", "edition": "linuxcnc-2.9", "observed": "rs274-2.9-observed", "offers": ["shows"]}


class Unsupported(Exception):
    """The controller does not have what the scenario needs."""


def run(scenario):
    """What rs274 did. Each run is a process of its own, so that `reset` has nothing to do."""
    source = Source(scenario["program"])
    if reason := support.why_not(scenario, source):
        raise Unsupported(reason)
    with hal(source) as has_hal:
        try:
            observed = Session(scenario, source, has_hal).observe()
        except DecidedByLine as why:
            raise Unsupported(why.__doc__) from None
    if observed is None:
        raise Unsupported("a program that does not end")
    found = outcome(scenario, source, observed)
    if found["end"]["end"] == "unsupported":
        raise Unsupported(found["end"]["what"])
    bounds = scenario.get("budget", {})
    effects = sum("do" in event for step in found["steps"] for event in step["events"])
    if len(found["steps"]) > bounds.get("steps", 100_000) or effects > bounds.get("effects", 100_000):
        raise Unsupported("a program that does not end")
    return found


def shows(scenario):
    """What is observed of a scenario: before it is run, the referee asks."""
    return support.shows(DECLARATION["observables"], DECLARATION["resolution"], scenario, Source(scenario["program"]))


for request in map(json.loads, sys.stdin):
    answer = {"hello": {"hello": DECLARATION}, "reset": {"done": {}}, "bye": {"done": {}}}.get(request["op"])
    answer = {"shows": shows(request["scenario"])} if request["op"] == "shows" else answer
    try:
        answer = answer or ({"outcome": run(request["scenario"])} if request["op"] == "run" else {"refused": "unknown operation"})
    except Unsupported as why:
        answer = {"unsupported": str(why)}
    print(json.dumps({"id": request["id"], **answer}), flush=True)
    if request["op"] == "bye":
        break
