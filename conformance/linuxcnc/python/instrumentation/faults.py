"""Error messages: which block was refused, and why.

The messages carry no number, so a fragment of the text decides; the first one that is contained in the message wins. A message without a row is no
fault but an error of this adapter: a wrong kind would be judged, an unknown one is seen.
"""
import re

from .plan import LONGEST_LINE, length
from .text import code, last_comment

# Kinds and fragments, special ones before general ones.
KINDS = [
    # Text.
    ("line_too_long", ["Command too long"]),
    ("no_such_axis", ["Bad character 'a' used", "Bad character 'b' used", "Bad character 'c' used"]),
    ("no_such_axis", ["Bad character 'u' used", "Bad character 'v' used", "Bad character 'w' used"]),
    ("bad_character", ["Bad character"]),
    ("bad_comment", ["Unclosed comment", "Nested comment"]),
    ("bad_number", ["bad number format", "No characters found in reading", "Bad format unsigned integer"]),
    ("missing_end", ["File ended with no percent sign"]),
    # Expressions.
    ("bad_expression", ["Unclosed expression", "Unknown operation", "Unknown word where unary operation", "Unknown word starting with",
        "Left bracket missing", "Slash missing after first atan", "Expected # reading", "Expected ] reading"]),
    ("divide_by_zero", ["divide by zero"]),
    ("out_of_domain", ["Calculation resulted in", "Negative argument to sqrt", "Zero or negative argument to ln", "Argument to acos",
        "Argument to asin", "raise negative to non integer"]),
    # Parameters.
    ("parameter_out_of_range", ["Parameter number out of range"]),
    ("read_only_parameter", ["read-only parameter", "Parameter is readonly", "Could not assign #<_hal["]),
    ("bad_block", ["Equal sign missing", "Named parameter not terminated"]),
    ("no_such_parameter", ["not found in INI file", "Named hal parameter", "not defined"]),
    # Subroutines and control: before words, since some of them name words.
    ("nested_sub", ["Nested subroutine definition"]),
    ("duplicate_sub", ["redefining sub"]),
    ("duplicate_label", ["duplicate O-word label"]),
    ("unknown_label", ["undefined O-word label", "no matching"]),
    ("outside_sub", ["ot in a subroutine definition", "Not in subroutine definition"]),
    ("unknown_sub", ["seeking o-word", "before EOF", "File not open"]),
    ("too_many_levels", ["Too many subroutine levels"]),
    ("too_many_arguments", ["Too many subroutine parameters"]),
    ("mixed_styles", ["must be called with", "must end with 'M99'", "must follow 'O.... sub'", "instead of 'O endsub'"]),
    ("fanuc_disabled", ["DISABLE_FANUC_STYLE_SUB"]),
    ("missing_word", ["code with no P-word"]),
    ("bad_block", ["Internal error: Could not assign", "Unexpected character after O-word", "Unknown control command in o word", "Unknown oword",
        "found in illegal location"]),
    ("bad_file", ["Unable to open file"]),
    ("nothing_saved", ["Cannot restore context"]),
    # Words.
    ("repeated_word", ["words on one line"]),
    ("modal_conflict", ["used from same modal group"]),
    ("too_many_m_codes", ["Too many m codes"]),
    ("unknown_code", ["Unknown g code", "Unknown m code", "G-code out of range", "M-code greater than", "Negative g code", "Negative m code"]),
    ("unused_word", ["to use it", "word with no "]),
    ("not_an_integer", ["Non integer value for integer", "to be a whole number", "not an integer"]),
    # Compensation.
    ("compensation_active", ["with cutter radius comp", "with cutter compensation", "with tool radius comp", "cutter radius comp on when on"]),
    ("modal_conflict", ["compensation allowed only in"]),
    ("gouging", ["gouging", "concave corner", "cutter compensation entry", "Radius of cutter compensation", "Tool radius not less", "inside corner"]),
    # Spindles and tools.
    ("spindle_out_of_range", ["Spindle ($) number out of range", "Invalid spindle ($) number"]),
    ("zero_speed", ["zero spindle speed", "pindle not turning", "not turning in G76"]),
    ("modal_conflict", ["Spindle turning"]),
    ("word_out_of_range", ["Requested tool -", "Negative tool id"]),
    ("tool_not_found", ["not found in the tool table"]),
    ("missing_word", ["Need tool prepared"]),
    # Motion and settings.
    ("zero_feed", ["Zero feed", "zero feed rate", "0 feedrate"]),
    ("axis_words", ["without a g code that uses them", "both use axis values", "axis values with g80"]),
    ("missing_word", ["All axes missing", "F word missing", "S word missing", "Dwell time missing", "word missing", "words missing",
        "words all missing", "No valid P word", "with no D word", "Need to have either a valid P"]),
    ("word_out_of_range", ["Need non-negative Q-word", "does not have L0", "out of range", "out of bounds", "must be", "requires a value",
        "should be 1 or greater", "Invalid analog index", "Negative f word", "Negative spindle speed", "Negative h word", "Negative l word",
        "Negative d word", "Negative or zero q value", "Zero timeout", "zero repeats", "Can't select analog input"]),
    ("modal_conflict", ["both a digital and an analog", "G4 not allowed with G2 or G3", "g53 incremental", "g0 or g1 with g53", "Cannot use g53",
        "not allowed with loaded tool"]),
    ("unused_word", ["not allowed with G10", "not allowed in G10"]),
    ("missing_word", ["without offsets has no effect"]),
    ("modal_conflict", ["but plane is not G18"]),
    ("axis_words", ["Can not have both H and axis words"]),
    ("modal_conflict", ["polar coordinate except in G17", "polar coordinates with G53"]),
    ("no_such_axis", ["lacking X or Y axes"]),
    ("axis_words", ["olar coordinate"]),
    ("word_out_of_range", ["Invalid absolute position"]),
    ("axis_words", ["Indexing axis"]),
    ("word_out_of_range", ["Invalid tool orientation"]),
    # Arcs, cycles and probing.
    ("bad_arc", ["Mixed radius ijk", "given for arc", "Radius to end of arc differs", "Zero-radius arc", "Arc radius too small",
        "same as end point of arc"]),
    ("probe", ["Cannot probe", "too close to probe point"]),
    ("missing_word", ["unspecified in"]),
    ("word_out_of_range", ["R less than"]),
    ("modal_conflict", ["canned cycle", "arc in planes", "for plane", "can only be used in XZ plane"]),
    ("gouging", ["arcs have the same center", "intersect parallel lines", "Corner finish failed"]),
    ("unused_word", ["F word used with"]),
    ("axis_words", ["rotary axes with G76"]),
    ("word_out_of_range", ["In G76, I must not"]),
    ("spindle_out_of_range", ["Invalid D-number in G76"]),
    ("word_out_of_range", ["Invalid D-number", "Invalid E-number"]),
    ("zero_speed", ["Spindle state unknown"]),
    ("bad_block", ["G7X error", "G7x error"]),
    ("missing_word", ["G7x.x"]),
    ("bad_block", ["Not monotonic"]),
    ("modal_conflict", ["Between G5.2 and G5.3", "without G5.2 first"]),
    ("axis_words", ["Splines may not have motion"]),
    ("missing_word", ["Must specify both"]),
    ("word_out_of_range", ["Must specify positive weight"]),
    ("missing_word", ["Can specify P without X and Y", "You must specify"]),
]
GREETING = "executing"  # what the program says first, and means nothing


def kind_of(message):
    """What a message means, if a row explains it."""
    return next((kind for kind, fragments in KINDS if any(fragment in message for fragment in fragments)), None)


def kinds(errors):
    """The kinds of fault that an error output names: its words may hold a line number, which checkpoints change."""
    return [kind_of(line) for line in errors.split("\n")[:2] if kind_of(line)]


def told(errors):
    return [line for line in errors.split("\n") if line.strip() and line != GREETING]


def message(errors):
    """The words of an error output, for a person."""
    lines = told(errors)
    return next((line for line in lines if kind_of(line)), lines[0] if lines else None)


def fault(errors, source, plan, following):
    """The fault that an error output tells; `following` is the place after the last one that is known to have been executed.

    The message stands first, the refused line last. A line that a jump can reach has a tag; any other is the next one.
    """
    lines = told(errors)
    echo = lines.pop() if len(lines) > 1 else ""
    first = lines[0] if lines else ""
    said = next((line for line in lines if kind_of(line)), None)
    aborts = abort_text(echo)
    if aborts is not None and (said is None or first.strip() == aborts):
        said, kind = first, "aborted_by_program"
    elif said is None:
        raise ValueError(f"unknown error: {' | '.join(lines)}")
    else:
        kind = kind_of(said)
    place = refused_place(kind, said, echo, source, plan, following)
    found = {"end": "fault", "message": plan.untagged(said)}
    if not is_ambiguous(kind, said, "" if place is None else source.line(place)):
        found["kind"] = kind
    return found if place is None else found | {"block": source.block(place)}


def refused_place(kind, said, echo, source, plan, following):
    if kind == "missing_end":  # the line is merely the last one that was read
        return None
    if kind == "line_too_long":
        return too_long(source, following)
    # The echo is the last line that a call sought through, or the definition that it found, or what a restore tried, or
    # the end of the profile that a lathe cycle has read.
    after_profile = said.startswith("G7X error") and re.search("endsub|return", code(echo))
    if kind in ("unknown_sub", "mixed_styles") or said.startswith("M7x:") or after_profile:
        return following
    is_next = echo.strip() in (source.line(following).strip(), plan.release)
    read = plan.tagged(echo) or (following if is_next else source.only_line(echo))
    calls_profile = re.fullmatch("O.* CALL", echo)  # the line by which a lathe cycle calls its profile
    return following if read is None and calls_profile else read


def too_long(source, following):
    """The next line that is too long, which the interpreter may have come upon while it skipped a sub."""
    file, line = following
    places = [(file, number) for of, number, text in source.all() if of == file and length(text) > LONGEST_LINE]
    return next((place for place in places if place[1] >= line), places[0] if places else None)


def is_ambiguous(kind, said, line):
    """Whether the message may as well mean another kind, so that none is told: it is the same for a word's value and a parameter's number, and for a
    word that is missing and one that is negative."""
    if kind == "not_an_integer":
        return "#" in code(line)
    if "Dwell time missing" in said:
        return "p" in code(line)
    return "P value out of range" in said and "p" not in code(line)


def abort_text(line):
    """The text of (ABORT,…), if it is what the line ends in."""
    command, comma, text = (last_comment(line) or "").partition(",")
    return text.strip() if comma and command.strip().lower() == "abort" else None
