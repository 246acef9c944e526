"""A kit for adapters: `declaration` says what a controller has, `serve` answers the requests of Gaugeblock.

The protocol is JSON, one line a message, over the standard streams: `gaugeblock adapter protocol` prints it.
"""
import json
import sys

PROTOCOL = 1


class Unsupported(Exception):
    """The controller does not have what the scenario needs. The case is unsupported, and never passes."""


def declaration(name, version, *, fields=(), effects=(), fields_at_effects=(), languages=("rs274",),
                units=("mm", "inch"), features=(), moves_in_place=False, fault_kinds=False,
                final_parameters=False, pins=(), resolution=0.0, clock="virtual", **more):
    """What a controller is and what it reports. Nothing else is judged.

    `fields` are reported after each block, `fields_at_effects` also with each effect; `gaugeblock adapter vocabulary`
    lists both, the effects and the features. `resolution` is the smallest step of a reported length, millimetres.
    `more` is taken over as it is, such as `language` or `sessions`.
    """
    observables = {
        "fields": list(fields), "fields_at_effects": list(fields_at_effects), "effects": list(effects),
        "moves_in_place": moves_in_place, "fault_kinds": fault_kinds, "final_parameters": final_parameters,
        "pins": list(pins)}
    return {
        "protocol": PROTOCOL, "name": name, "version": version, "languages": list(languages), "units": list(units),
        "features": list(features), "observables": observables, "resolution": resolution, "clock": clock, **more}


def fault(message, *, file="main.ngc", line=None, kind=None):
    """The end of a program whose block the controller refuses. `kind` only where the declaration has `fault_kinds`."""
    end = {"end": "fault", "message": message}
    if line is not None:
        end["block"] = {"file": file, "line": line}
    if kind is not None:
        end["kind"] = kind
    return end


def program_end():
    """The end of a program by M2 or M30."""
    return {"end": "program_end"}


def step(line, *, file="main.ngc", events=(), state=None, language="rs274"):
    """What one block did: its events in order, and the state after it."""
    block = {"block": {"file": file, "line": line}, "events": list(events)}
    if state is not None:
        block["state"] = {"language": language, **state}
    return block


def effect(name, **arguments):
    """An event: the controller does something, such as `effect("dwell", seconds=2.0)`."""
    return {"do": {"effect": name, **arguments}}


def outcome(steps, end, *, start=None, language="rs274", **more):
    """All that was observed of a run. `start` has the settings before the first block."""
    return {"language": language, "start": start or {}, "steps": list(steps), "end": end, **more}


def serve(declared, run, *, reset=None, requests=None, answers=None):
    """Answers requests until `bye` or the end of the input.

    `run(scenario)` returns an outcome or raises `Unsupported`. `reset()` puts the controller into its first state; it
    is called before each scenario. What else `run` raises ends the process: a crash, which fails the case.
    """
    requests, answers = requests or sys.stdin, answers or sys.stdout
    for line in requests:
        request = json.loads(line)
        operation = request["op"]
        try:
            answer = _answer(operation, request, declared, run, reset)
        except Unsupported as why:
            answer = {"unsupported": str(why)}
        print(json.dumps({"id": request["id"], **answer}), file=answers, flush=True)
        if operation == "bye":
            return


def _answer(operation, request, declared, run, reset):
    if operation == "hello":
        return {"hello": declared}
    if operation == "reset":
        if reset is not None:
            reset()
        return {"done": {}}
    if operation == "run":
        return {"outcome": run(request["scenario"])}
    if operation == "bye":
        return {"done": {}}
    return {"refused": f"unknown operation: {operation}"}
