#!/usr/bin/env python3
"""An adapter for Gaugeblock, protocol 1: connect your controller in `run`. `gaugeblock adapter protocol` has the rest."""
import json, re, sys

DECLARATION = {
    "protocol": 1, "name": "toy", "version": "0.1", "languages": ["rs274"], "units": ["mm", "inch"],
    "features": [],  # what a scenario may need besides its program: `gaugeblock adapter vocabulary`
    "observables": {  # what is judged, and nothing else
        "fields": ["motion", "position"], "fields_at_effects": [], "effects": ["straight_traverse", "straight_feed"],
        "moves_in_place": True, "fault_kinds": False, "final_parameters": False, "pins": []},
    "language": {"g": ["0", "1", "21"], "m": ["2"], "axes": "XYZ", "letters": "F", "parameters": [],  # it runs no more
                 "expressions": False, "o_words": False, "comments": []},
    "resolution": 0.0, "clock": "virtual"}
MOTIONS = {0: ("traverse", "straight_traverse"), 1: ("feed", "straight_feed")}
WORD = re.compile(r"([a-z])([-+0-9.]+)")


class Unsupported(Exception):
    """The controller does not have what the scenario needs."""


def run(scenario):
    """What the controller did. This one knows G0, G1, G21, F and M2, and begins anew each time: `reset` has nothing to do."""
    steps, motion, feed, point = [], ("none", None), 0.0, {"x": 0.0, "y": 0.0, "z": 0.0}
    outcome = {"language": "rs274", "start": {}, "steps": steps}
    for line, text in enumerate(scenario["program"]["main"].lower().splitlines(), 1):
        block, text = {"file": "main.ngc", "line": line}, re.sub(r"^\s*/|\s", "", text)
        if not text:
            continue  # a blank line is not executed
        if not re.fullmatch(r"(?:[a-z][-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+))*", text):
            raise Unsupported("anything but plain words")
        words = [(letter, float(number)) for letter, number in WORD.findall(text)]
        for letter, number in words:
            if letter == "g" and number > 99.9:
                return {**outcome, "end": {"end": "fault", "block": block, "message": f"no such code: G{number:g}"}}
            if letter not in "xyzf" and (letter, number) not in [("g", 0), ("g", 1), ("g", 21), ("m", 2)]:
                raise Unsupported(f"the word {letter.upper()}{number:g}")
            motion = MOTIONS[number] if letter == "g" and number in MOTIONS else motion
            feed = number if letter == "f" else feed
        moved = {letter: number for letter, number in words if letter in "xyz"}
        if moved and (motion[1] is None or motion[0] == "feed" and feed <= 0):
            return {**outcome, "end": {"end": "fault", "block": block, "message": "no motion mode, or no feed"}}
        point = {**point, **moved}
        events = [{"do": {"effect": motion[1], "end": point}}] if moved else []
        motion = MOTIONS[1] if ("m", 2) in words else motion
        steps.append({"block": block, "events": events, "state": {"language": "rs274", "motion": motion[0], "position": point}})
        if ("m", 2) in words:
            return {**outcome, "end": {"end": "program_end"}}
    raise Unsupported("a program without M2")


for request in map(json.loads, sys.stdin):
    answer = {"hello": {"hello": DECLARATION}, "reset": {"done": {}}, "bye": {"done": {}}}.get(request["op"])
    try:
        answer = answer or ({"outcome": run(request["scenario"])} if request["op"] == "run" else {"refused": "unknown operation"})
    except Unsupported as why:
        answer = {"unsupported": str(why)}
    print(json.dumps({"id": request["id"], **answer}), flush=True)
    if request["op"] == "bye":
        break
