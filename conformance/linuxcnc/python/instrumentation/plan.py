"""The program with its checkpoints: lines after each line that say where the run is, and show what parameters can show.

(DEBUG,…) would do as well, but a program can switch it off.
"""
from .text import DEBUG_SWITCH, LAST_PARAMETER, Form, form, has_slash, without_number

LONGEST_LINE = 252  # that the interpreter reads
ROOM_TO_BIND = 40  # characters that binding an end to a parameter may take
# How many parameters a checkpoint line shows: a message of more than about 500 characters, values and all, crashes the interpreter, and large numbers
# are long.
MOST_VALUES = 12

# Parameters that show a mode, printed as whole numbers.
MODES = [
    ["_motion_mode", "_plane", "_metric", "_absolute", "_inverse_time", "_units_per_minute", "_ccomp", "_coord_system", "_retract_old_z",
     "_ijk_absolute_mode", "_lathe_diameter_mode"],
    ["_mist", "_flood", "_feed_override", "_speed_override", "_adaptive_feed", "_feed_hold", "_spindle_css_mode", "_spindle_on", "_spindle_cw",
     "_selected_tool", "_selected_pocket", "_call_level"]]
# Those that show a number, printed with nine decimals.
NUMBERS = ["_feed", "_rpm", "_x", "_y", "_z", "_a", "_b", "_c"]
# The other names that the interpreter provides.
PROVIDED = {
    "_vmajor", "_vminor", "_metric_machine", "_line", "_imperial", "_incremental", "_units_per_rev", "_tool_offset", "_retract_r_plane",
    "_spindle_rpm_mode", "_lathe_radius_mode", "_current_tool", "_current_pocket", "_u", "_v", "_w", "_abs_x", "_abs_y", "_abs_z", "_abs_a",
    "_abs_b", "_abs_c", "_abs_u", "_abs_v", "_abs_w", "_value", "_value_returned", "_task", "_remap_level", *MODES[0], *MODES[1], *NUMBERS}


class Plan:
    """How a program is observed: it shows the parameters that its text names, #1 to #30, and `more`."""

    def __init__(self, source, more=frozenset()):
        self.marker = unused_marker(source)
        numbers = sorted(number for number in {*range(1, 31), *source.numbered, *more} if is_plain(number))
        names = sorted(name for name in source.named - PROVIDED if name.replace("_", "a").isalnum())
        # Where line numbers matter, what blocks compute under observation is not what they compute.
        self.parameters = [] if source.names_line() else [*map(str, numbers), *(f"<{name}>" for name in names)]
        self.groups = groups(self.parameters)
        self.stop = f"(ABORT,{self.marker})"
        self.by_hand_sign = f"{self.marker}by hand"
        # Under cutter compensation calls wait. A comment of each checkpoint waits with them; before an end, M1 puts all out.
        self.compensates = source.may_compensate()
        self.waiting_comment = f"{self.marker}+"
        self.release_comment = f"{self.marker}release"
        self.release = f"M1 ({self.release_comment})"

    def instrumented(self, file, lines, ends):
        """The text of a file with checkpoints and tags, and with an error before each line of `ends`: the program stops there, its state alive."""
        first = next((line for line in lines if line.strip()), "")
        begun = form(first) is not Form.PERCENT
        text = self.checkpoint(file, 0) if file == 0 and begun else ""
        for number, line in enumerate(lines, 1):
            end = ends.place(line)
            if end is not None:
                text += f"{self.release}\n" if self.compensates else ""
                text += f"#<{self.reached(end)}>=1\n{self.stop}\n"
            text += line + self.tag(file, number, line) + "\n"
            # Nothing but blanks may stand before the first percent sign.
            begun = begun or line.strip() != ""
            text += self.checkpoint(file, number) if begun else ""
        return text

    def checkpoint(self, file, line):
        """The checkpoint lines that stand after a line."""
        shown = [*(("%d", [f"<{name}>" for name in names]) for names in MODES), ("%.9f", [f"<{name}>" for name in NUMBERS])]
        shown += [("%.9f", group) for group in self.groups]
        comment = f"({self.waiting_comment})\n" if self.compensates else ""
        return comment + "".join(f"(PRINT,{self.marker} {file} {line} {part} {how}" + "".join(f" #{name}" for name in names) + ")\n"
                                 for part, (how, names) in enumerate(shown))

    def by_hand(self, ends):
        """What is entered by hand once the program has stopped: a sign, the end before which it stopped, and a checkpoint.

        An end is bound to a parameter that is set before it, so that none is executed where an error stopped the program; one that leaves no room
        for that is entered as it is.
        """
        text = f"(PRINT,{self.by_hand_sign})\n"
        for place, end in enumerate(ends.blocks):
            reached = self.reached(place)
            text += (f"#<{reached}>=[1/#<{reached}>] {end}" if has_room(end) else end) + "\n"
        return text + self.checkpoint(0, 0) + "quit\n"

    def reached(self, end):
        """The parameter that says before which end the program stopped."""
        return f"_{self.marker.strip('@')}{end}"

    def tag(self, file, number, line):
        """A tag that an error message shows, on lines that a jump can reach. It stands in a comment; comments of O-word lines are never executed, so
        that it hides nothing."""
        tag = f";{self.marker}{file}.{number}"
        return tag if form(line) is Form.CONTROL and length(line + tag) <= LONGEST_LINE else ""

    def tagged(self, echo):
        """Which place an error message's echo names by its tag."""
        _, found, tag = echo.rpartition(f";{self.marker}")
        file, _, line = tag.strip().partition(".")
        return (int(file), int(line)) if found and file.isdecimal() and line.isdecimal() else None

    def untagged(self, text):
        return text.split(f";{self.marker}")[0]


class Ends:
    """The blocks that end a program, each different one once, as they can be entered by hand."""

    def __init__(self, source, block_delete):
        self.block_delete = block_delete
        entered = (self.entered(line) for _, _, line in source.all())
        self.blocks = list(dict.fromkeys(block for block in entered if block is not None))

    def drop(self, line):
        """Leaves out the block at this line, which is no end after all; all of them where it is none of them."""
        place = self.place(line)
        self.blocks = [] if place is None else self.blocks[:place] + self.blocks[place + 1:]

    def are_bound(self):
        """Whether each of them is executed by hand only if the program stopped before it."""
        return all(map(has_room, self.blocks))

    def place(self, line):
        """Which of the blocks a line is."""
        block = self.entered(line)
        return self.blocks.index(block) if block in self.blocks else None

    def entered(self, line):
        """A line that ends a program, without slash and line number; None for any other, and for one with a carriage return, which is more than one
        line to a person's input."""
        is_skipped = self.block_delete and has_slash(line)
        return without_number(line) if form(line) is Form.END and not is_skipped and "\r" not in line else None


def groups(parameters):
    """The parameters that one checkpoint line after another shows."""
    found, room = [], 0
    for name in parameters:
        if not found or len(found[-1]) == MOST_VALUES or room <= length(name) + 2:
            found.append([])
            room = LONGEST_LINE - 60
        found[-1].append(name)
        room -= length(name) + 2
    return found


def is_plain(number):
    """Whether a numbered parameter is only written by the program: not offsets and predefined positions, whose unit is that of stored data, and not
    the position and the tool, which other fields show."""
    return 1 <= number <= LAST_PARAMETER and not 5161 <= number <= 5428


def is_seen(number, plan):
    return not is_plain(number) or number == DEBUG_SWITCH or str(number) in plan.parameters


def has_room(end):
    return length(end) <= LONGEST_LINE - ROOM_TO_BIND


def length(text):
    """In bytes, as the interpreter counts."""
    return len(text.encode())


def unused_marker(source):
    text = "\n".join(line.lower() for _, _, line in source.all())
    salt = next(salt for salt in range(len(text) + 1) if f"gb{salt}" not in text)
    return f"@gb{salt}@"
