"""Puts calls, checkpoints and the error message together to an outcome."""
import copy

from . import state
from .canon import Canon
from .faults import fault, message
from .printed import Call, Checkpoint
from .steps import Steps
from .text import Form
from .waiting import Rescaled, in_program_order


def outcome(scenario, source, observed):
    """The outcome of a run; one that ends with `unsupported` is no outcome, but the reason why there is none."""
    making = Making(scenario, source, observed)
    lines = in_program_order(observed.lines) if observed.plan.compensates else observed.lines
    for line in lines:
        making.read(line)
        if making.end:
            break
    end = making.end or making.fault()
    # Where not even the first checkpoint was reached, what the calls have set is all that is known of the start.
    start = making.canon.now if making.start is None else making.start
    return {"language": "rs274", "start": start, "steps": making.steps.taken, "end": end,
            "parameters": shown_parameters(scenario, observed.parameters)}


class Making:
    """An outcome in the making."""

    def __init__(self, scenario, source, observed):
        self.source, self.observed = source, observed
        self.canon = Canon(scenario.get("machine", {}).get("tools", []))
        self.steps = Steps(source, scenario["program"].get("block_delete", False))
        self.start = self.end = None

    def read(self, line):
        match line:
            case Checkpoint():
                self.checkpoint(line)
            case Call(name="PROGRAM_END"):
                self.program_end()
            case Call(name="FINISH"):
                # It is called too where a label was sought up to the percent sign, which is an error.
                self.end = None if self.observed.refused else {"end": "percent_end"}
            case Call():
                self.canon.call(line)
            case Rescaled():
                self.unsupported(Rescaled.__doc__)
            case str():
                self.canon.message("print", line)

    def checkpoint(self, checkpoint):
        self.canon.settle(checkpoint)
        if self.steps.at is None:
            self.canon.set({"tool_offset": {}} | state.others(checkpoint))
            self.canon.take_events()
            self.start = copy.deepcopy(self.canon.now)
            self.steps.begin(checkpoint)
        else:
            self.steps.passed(checkpoint, self.canon.take_events(), self.canon.tool)
        self.canon.stands_before(self.source.line(self.steps.next()), checkpoint)

    def program_end(self):
        if self.steps.next_form() is Form.RETURN:
            self.unsupported("M99 in the main program: it ends here, though it should begin again")
        elif self.observed.after_end is None:
            self.unsupported("an end whose state cannot be queried")
        else:
            self.canon.program_end(self.observed.after_end)
            self.steps.ended(self.observed.after_end, self.observed.parameters, self.canon.take_events(), self.canon.tool)
            self.end = {"end": "program_end"}

    def unsupported(self, what):
        self.end = {"end": "unsupported", "block": self.source.block(self.steps.next()), "what": what}

    def fault(self):
        if not self.observed.refused:
            raise ValueError(f"a run without an end: {self.observed.errors[-300:]}")
        found = fault(self.observed.errors, self.source, self.observed.plan, self.steps.next())
        words = message(self.observed.plain_errors)
        return found | ({"message": words} if words else {})


def shown_parameters(scenario, parameters):
    """Parameters at the end, without those of probing, which are not stored, those that only repeat position and tool, and stored lengths on a machine
    whose unit is not the one in which this controller stores them."""
    hidden = {*range(5061, 5071), *range(5400, 5429)}
    if scenario.get("machine", {}).get("length_unit", "mm") != "inch":
        hidden |= {*range(5161, 5391)} - {5220}
    return {str(number): value for number, value in sorted(parameters.items()) if number not in hidden}
