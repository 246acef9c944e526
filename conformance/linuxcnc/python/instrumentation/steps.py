"""Executed blocks, made of one checkpoint after the other."""
from .settings import take
from .state import state
from .text import Form, code, form, has_slash, opens_probe_log


class Steps:
    """The blocks that were executed so far."""

    def __init__(self, source, block_delete):
        self.source, self.block_delete = source, block_delete
        self.taken = []
        self.known = {}  # of the state, as it was told
        self.level = 0  # depth of calls where the last checkpoint stood
        self.at = None  # the place of the last checkpoint
        self.changed = False  # whether the tool was changed since the last T: then none is selected, though parameters may keep the old one
        self.logs_probing = False  # whether a file for probed points is open

    def next(self):
        """The place of the block that is executed next if nothing jumps."""
        return (self.at[0], self.at[1] + 1) if self.at else (0, 1)

    def next_form(self):
        return form(self.source.line(self.next()))

    def begin(self, checkpoint):
        """The first checkpoint: parameters that the program does not name are taken as they are, only their changes are of interest."""
        is_named = lambda name: name.isdecimal() and int(name) in self.source.numbered
        take(self.known, {"parameter": {name: value for name, value in checkpoint.parameters.items() if not is_named(name)}})
        self.at = checkpoint.place

    def passed(self, checkpoint, events, tool):
        """A block was executed; the run is now behind it, or where it jumped to."""
        self.tool_codes(events)
        place, jumped = self.next(), checkpoint.place != self.next()
        kind, line = self.next_form(), self.source.line(place)
        was, self.level = self.level, checkpoint.modes["_call_level"]
        if was != self.level or kind is Form.RETURN:
            self.led_elsewhere()
        is_skipped = self.block_delete and has_slash(line)
        does_nothing = (self.closes_nothing(line, is_skipped) or kind in (Form.EMPTY, Form.PERCENT)) and not events
        if kind is Form.CALL and jumped:
            # The call counts when it returns; what its block did, it did before the sub.
            if events:
                self.step(place, events)
        elif kind in (Form.CALL, Form.CONTROL, Form.RETURN):
            self.step(place, events)
        elif not does_nothing and not is_skipped:
            self.step(place, events, take(self.known, self.shown(checkpoint, tool)))
        if jumped and form(self.source.line(checkpoint.place)) is Form.CALL:
            self.step(checkpoint.place, [])
        self.at = checkpoint.place

    def ended(self, checkpoint, parameters, events, tool):
        """The program ended with the next block; what was shown afterwards, and all numbered parameters that are not zero."""
        self.tool_codes(events)
        shown = self.shown(checkpoint, tool)
        if self.level:
            self.led_elsewhere()
            # It was not the end but the stop before it that showed #1 to #30: the list at the end has what they are.
            arguments = {str(number) for number in range(1, 31)} & shown["parameter"].keys()
            shown["parameter"] |= {number: parameters.get(int(number), 0.0) for number in arguments}
        self.step(self.next(), events, take(self.known, shown))

    def closes_nothing(self, line, is_skipped):
        """Whether a line is a (PROBECLOSE) alone, and no file is open: a comment that does nothing is no block."""
        opens = None if is_skipped else opens_probe_log(line)
        if opens is None:
            return False
        was_open, self.logs_probing = self.logs_probing, opens
        return not opens and not was_open and code(line) in ("", "/")

    def led_elsewhere(self):
        """After a call or return the level is recorded anew, and with it the local names that exist."""
        self.known.pop("call_level", None)
        parameters = self.known.get("parameter", {})
        self.known["parameter"] = {name: value for name, value in parameters.items() if name.startswith("_") or name.isdecimal()}

    def tool_codes(self, events):
        for event in events:
            effect = event.get("do", {}).get("effect")
            if effect in ("prepare_tool", "change_tool"):
                self.changed = effect == "change_tool"

    def shown(self, checkpoint, tool):
        return state(checkpoint, tool) | ({"prepared_tool": -1} if self.changed else {})

    def step(self, place, events, changes=None):
        """A block; where no state is told, only its events are known."""
        told = {} if changes is None else {"state": {"language": "rs274", **changes}}
        self.taken.append({"block": self.source.block(place), "events": events, **told})
