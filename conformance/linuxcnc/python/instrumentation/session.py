"""The runs that one outcome takes: one under observation and beyond the end, and one without checkpoints where that is needed."""
import dataclasses
import re

from . import faults, machine, printed
from .plan import Ends, Plan, is_seen
from .printed import Call, Checkpoint

# What rs274 says when an error has stopped the program and it takes blocks from standard input, and the arguments that make it do so.
BY_HAND = "starting MDI"
MANUAL_INPUT = ("-n", "1")


@dataclasses.dataclass
class Observed:
    """What the runs showed."""

    plan: Plan
    lines: list  # calls, texts and checkpoints, as printed.read tells them
    errors: str  # error output of the program itself
    refused: bool  # whether an error stopped the program
    after_end: Checkpoint | None  # what was shown after the program's end, if it reached that
    parameters: dict[int, float]  # those that are not zero at the end
    plain_errors: str = ""  # error output of the run without checkpoints, whose line numbers are those of the program

    def last_checkpoint(self):
        return next((line for line in reversed(self.lines) if isinstance(line, Checkpoint)), None)

    def stopped_in_vain(self):
        """Whether the program was stopped before an end that was none when it was entered by hand."""
        return self.after_end is not None and not any(isinstance(line, Call) and line.name == "PROGRAM_END" for line in self.lines)


class DecidedByLine(Exception):
    """#<_line> decides what is done, and checkpoints are lines, too."""


class Session:
    """One scenario on rs274."""

    def __init__(self, scenario, source, has_hal):
        self.scenario, self.source, self.has_hal = scenario, source, has_hal

    def observe(self):
        """Runs the program; None where it does not end."""
        ends = Ends(self.source, self.scenario["program"].get("block_delete", False))
        observed = self.run_instrumented(ends)
        # A block that looks like an end and is none must show what it does where it stands.
        while observed and observed.stopped_in_vain() and ends.blocks:
            file, line = observed.last_checkpoint().place if observed.last_checkpoint() else (0, 0)
            ends.drop(self.source.line((file, line + 1)))
            observed = self.run_instrumented(ends)
        if observed and (self.needs_plain(observed) or observed.refused and not ends.are_bound()):
            self.run_plain(observed)
        return observed

    def run_instrumented(self, ends):
        """The run with checkpoints, and beyond the program's end: there no checkpoint is reached, so that the program is stopped by an error before its last
        block, with its state alive, and that block and a checkpoint are entered by hand.

        Once more where it turns out that a parameter was written that no checkpoint showed.
        """
        more = set()
        while True:
            plan = Plan(self.source, more)
            texts = [plan.instrumented(file, lines, ends) for file, (_, lines) in enumerate(self.source.files)]
            ran = machine.start(self.scenario, self.source, texts, self.has_hal, *MANUAL_INPUT, typed=plan.by_hand(ends))
            unseen = {number for number in ran.parameters if not is_seen(number, plan)}
            if ran.status is None:
                return None
            if not self.source.computes_numbers or unseen <= more:
                return observed(plan, ran)
            more |= unseen

    def needs_plain(self, observed):
        """Parameters of a sub are gone once an error has stopped the program, and line numbers count checkpoint lines too."""
        last = observed.last_checkpoint()
        in_sub = last is not None and last.modes["_call_level"] > 0
        may_tell_line = observed.refused and re.search("[0-9]", faults.message(observed.errors) or "")
        return in_sub or may_tell_line or self.source.names_line()

    def run_plain(self, observed):
        """The run as the program stands. What it leaves in the parameters counts."""
        texts = ["".join(f"{line}\n" for line in lines) for _, lines in self.source.files]
        ran = machine.start(self.scenario, self.source, texts, self.has_hal)
        if ran.status is None:
            return
        observed.parameters, observed.plain_errors = ran.parameters, ran.errors
        if self.source.names_line():
            lines = printed.read(ran.printed, observed.plan)
            printed.adopt(observed.lines, lines)
            ends = [(observed.refused, faults.kinds(observed.errors)), (ran.status != 0, faults.kinds(ran.errors))]
            both = zip([*printed.doings(observed.lines), ends[0]], [*printed.doings(lines), ends[1]])
            if any(mine != other for mine, other in both):
                raise DecidedByLine


def observed(plan, ran):
    """Takes apart what the program did itself and what was entered by hand."""
    errors = ran.errors.split("\n")
    is_stopped = BY_HAND in errors
    if is_stopped:
        errors = errors[:len(errors) - 1 - errors[::-1].index(BY_HAND)]
    at_end = is_stopped and errors[-1:] == [plan.stop]
    text = ran.printed
    if at_end:
        text = text.replace(plan.by_hand_sign + "\n", "")
    elif is_stopped:
        text = text.split(plan.by_hand_sign + "\n")[0]
    seen = Observed(plan, printed.read(text, plan), "\n".join(errors), is_stopped and not at_end, None, ran.parameters)
    if at_end and seen.last_checkpoint():
        seen.after_end = seen.last_checkpoint()
        seen.lines = [line for line in seen.lines if line is not seen.after_end]
    return seen
