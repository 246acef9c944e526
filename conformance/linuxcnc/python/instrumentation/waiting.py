"""The program order of calls under cutter compensation.

A move in the plane waits until the next one is known, and other calls wait after it. A checkpoint's message does not wait, its comment does: what is
printed after the message of a checkpoint and before its comment has waited, and belongs before both. A call that does not wait belongs where it is
printed, and so does a joining move: it is printed when nothing waits any more.
"""
from .printed import Call, Checkpoint, Passed

MOTION = ("STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED")
RATES = ("SET_FEED_MODE", "SET_FEED_RATE", "SET_SPINDLE_SPEED", "SET_SPINDLE_MODE")
SWITCHES = ("START_SPINDLE_CLOCKWISE", "START_SPINDLE_COUNTERCLOCKWISE", "STOP_SPINDLE_TURNING", "MIST_ON", "MIST_OFF", "FLOOD_ON", "FLOOD_OFF",
            "DWELL", "ORIENT_SPINDLE")
MESSAGES = ("MESSAGE", "LOG", "LOGOPEN", "LOGAPPEND", "LOGCLOSE")


class Rescaled:
    """a move that waits for the next one while the length unit changes"""


def in_program_order(lines):
    """Lines, with the comments of checkpoints, in program order."""
    blocks, passed = [[]], 0
    for line in lines:
        is_late = isinstance(line, Call) and passed < len(blocks) - 1 and waits(line)
        if line is Passed.PASSED:
            passed += 1
        elif is_late:
            changed = any(isinstance(other, Call) and other.name == "USE_LENGTH_UNITS" for block in blocks[passed + 1:] for other in block)
            late = Rescaled() if changed and line.name in MOTION else line
            blocks[passed].insert(place(blocks[passed], line), late)
        else:
            blocks[-1].append(line)
            if isinstance(line, Checkpoint):
                blocks.append([])
    return sum(blocks, [])


def place(block, late):
    """Where a late call belongs among those of its block that were printed at once: before the checkpoint, and before T, G17 to G21, G7 and G8 where
    the block executes the call's word before these."""
    at = len(block)
    while at > 0:
        line = block[at - 1]
        is_later = isinstance(line, Call) and not waits(line) and order(line) > order(late)
        if not is_later and not isinstance(line, Checkpoint):
            break
        at -= 1
    return at


def order(call):
    """The order in which a block executes its words, as far as it matters here."""
    is_own = call.name == "COMMENT" and not call.text().startswith("interpreter: ")
    if is_own or call.name in MESSAGES:
        return 0
    if call.name in RATES or call.name == "COMMENT" and "feed mode" in call.text():
        return 1
    if is_lathe(call):
        return 5
    return {"SELECT_TOOL": 2, "SELECT_PLANE": 4, "USE_LENGTH_UNITS": 4, "COMMENT": 6}.get(call.name, 6 if call.name in MOTION else 3)


def waits(call):
    """Whether a call waits while a move does."""
    if call.name == "COMMENT":
        return not is_lathe(call)
    return call.name in (*MOTION, *RATES, *SWITCHES) or call.name.endswith("WAIT_ORIENT_COMPLETE")


def is_lathe(call):
    """Whether a comment reports G7 or G8, which do not wait."""
    return call.name == "COMMENT" and call.text().startswith("interpreter: Lathe diameter mode")
