"""What rs274 printed: canonical calls, checkpoints, and what (PRINT,…) prints."""
import dataclasses
import enum
import re
import typing

from .plan import MODES, NUMBERS

# The N word of the block stands as dots where there is none; a long one touches the name.
CALL = re.compile(r" *([0-9]+) N[0-9.]*\s*([A-Z0-9_.]+)\((.*)\)", re.S)
NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)(e[-+]?[0-9]+)?|[-+]?(inf|nan)")


class Call(typing.NamedTuple):
    """A canonical call as it is printed: `STRAIGHT_FEED(1.0000, …)`."""

    name: str
    arguments: str

    def words(self):
        return [word for word in re.split("[, ]+", self.arguments) if word]

    def numbers(self):
        return [float(word) for word in self.words() if NUMBER.fullmatch(word)]

    def text(self):
        return self.arguments.removeprefix('"').removesuffix('"')


@dataclasses.dataclass
class Checkpoint:
    """A place that the run reached, and what it showed there: modes and numbers by their names, the plan's parameters where they exist."""

    place: tuple[int, int]
    modes: dict[str, int]
    numbers: dict[str, float]
    parameters: dict[str, float]


class Passed(enum.Enum):
    """The comment of a checkpoint: all that waited before it is out."""

    PASSED = "passed"


def read(text, plan):
    """The lines of an output: calls, checkpoints (each of several lines), and text. One without its end is left out."""
    lines, parts, due, released = [], [], 1, False
    for line in text.split("\n")[:-1]:
        call = CALL.fullmatch(line)
        if line.startswith(plan.marker):
            file, number, part, *values = line.removeprefix(plan.marker).split()
            parts = [] if part == "0" else parts
            parts.append(values)
            if len(parts) == len(MODES) + 1 + len(plan.groups):
                lines.append(checkpoint((int(file), int(number)), parts, plan))
        elif call and int(call[1]) == due:
            due += 1
            call = Call(call[2], call[3])
            if call == ("COMMENT", f'"{plan.waiting_comment}"'):
                lines.append(Passed.PASSED)
            elif call == ("COMMENT", f'"{plan.release_comment}"'):
                released = True
            elif released and call.name == "OPTIONAL_PROGRAM_STOP":
                released = False
            else:
                lines.append(call)
        else:
            lines.append(line)
    return lines


def checkpoint(place, parts, plan):
    modes, numbers = parts[:len(MODES)], parts[len(MODES)]
    names = [name.strip("<>") for name in plan.parameters]
    shown = zip(names, sum(parts[len(MODES) + 1:], []), strict=True)
    return Checkpoint(
        place, dict(zip(sum(MODES, []), map(int, sum(modes, [])), strict=True)), dict(zip(NUMBERS, map(float, numbers), strict=True)),
        {name: float(value) for name, value in shown if not value.startswith("######")})


def doings(lines):
    """What the program did, checkpoints aside: for comparing a run under observation with one without."""
    return [line for line in lines if not isinstance(line, Checkpoint | Passed) and line != ("ON_RESET", "")]


def adopt(observed, unobserved):
    """Takes over the numbers and texts of a run without checkpoints where the same was done: `#<_line>` counts checkpoint lines too."""
    others = iter(unobserved)
    for place, mine in enumerate(observed):
        if isinstance(mine, Checkpoint | Passed):
            continue
        match mine, next(others, None):
            case (Call(name=name), Call(name=same) as other) if name == same:
                observed[place] = other
            case (str(), str() as other):
                observed[place] = other
