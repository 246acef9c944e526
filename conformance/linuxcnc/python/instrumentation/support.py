"""What can be run, and what is shown of it."""
import re

from .machine import MACHINE, PARAMETERS, PRINTED, TOOLS
from .text import LAST_PARAMETER, MAIN

OWN_ENVIRONMENT = "stand-alone rs274"  # answers as this controller does
STORING = ["g10", "g28.1", "g30.1", "g52", "g92"]  # codes that store lengths
# Lengths that are printed when they are set and not when the length unit changes: set in inches, they are shown with the error of inches.
CARRIED = ["feed_rate", "blend_tolerance", "naive_cam_tolerance", "g5x_offset", "g92_offset", "tool_offset"]


def why_not(scenario, source):
    """The reason why a scenario cannot be run; None where it can. What would reach the host must not run, whoever asks."""
    environment = scenario.get("environment", {})
    for name, _ in source.files[1:]:
        if not re.fullmatch(r"(elsewhere/)?[^./][^/]*", name) or name in (MAIN, MACHINE, TOOLS, PARAMETERS, PRINTED):
            return f"{name!r} is not a valid file name of a sub"
    if source.reaches_host():
        return "it would reach beyond the program's files, or run Python"
    if source.shows_open_name():
        return "a message that ends within a name prints whatever is in memory"
    if scenario["program"].get("start") == "mdi":
        return "O-words do not work in MDI"
    if environment.get("name") != OWN_ENVIRONMENT and source.pauses():
        return "programmed pauses do not pause"
    if environment and environment.get("name") != OWN_ENVIRONMENT:
        return "inputs and external signals cannot be varied"
    return of_machine(scenario.get("machine", {}), source)


def of_machine(machine, source):
    stored = [int(number) for number in machine.get("parameters", {})]
    if not all(1 <= number <= LAST_PARAMETER for number in stored):
        return "a parameter that cannot be stored"
    if not all(re.fullmatch(r"\[[^]]*\][^\x00-\x1f]*", name) for name in machine.get("ini", {})):
        return "a name that is not of the form [SECTION]NAME"
    if machine.get("length_unit", "mm") != "inch":
        if machine.get("tools") or any(5161 <= number <= 5390 and number != 5220 for number in stored):
            return "lengths that are stored are always in inches"
        # Where the program sets a stored length, or lets a code set it and reads it, it does something else.
        if any(map(is_length, source.assigned)) or source.has_g_code(*STORING) and any(map(is_length, source.numbered)):
            return "lengths that are stored are always in inches"
    return None


def is_length(number):
    """Whether a stored parameter is a length along X, Y, Z, U, V or W: of the points of G28 and G30, the offset of G92, or a coordinate system."""
    firsts = [5161, 5181, 5211, *range(5221, 5390, 20)]
    return any(number - first in (0, 1, 2, 6, 7, 8) for first in firsts)


def shows(declared, resolution, scenario, source):
    """What is observed of a scenario, of what is declared.

    Stored data of a millimetre machine stay hidden: this controller stores inches. Where a program asks for the number of a line, checkpoints change what
    it computes, and where its moves lead. F under inverse time is had from the text, or back from the moves, if they lead anywhere.
    """
    shown = dict(declared)
    if source.names_line():
        shown["fields"] = [field for field in shown["fields"] if field != "position"]
    if source.has_g_code("g93") and source.computes_word("f"):
        for fields in ("fields", "fields_at_effects"):
            shown[fields] = [field for field in shown[fields] if field != "feed_rate"]
    if source.has_g_code("g20"):
        shown["carried"] = dict.fromkeys(CARRIED, resolution * 25.4)
    if scenario.get("machine", {}).get("length_unit", "mm") != "inch":
        shown["hidden_parameters"] = shown["hidden_parameters"] + [[5161, 5219], [5221, 5390]]
    return shown
