"""Settings and states: what is in force, what has changed, and lengths in the unit that is active."""
INDEXED = {"speed_override", "spindle", "spindle_mode", "spindle_speed", "spindle_limit", "parameter"}
AXES, LINEAR = "xyzabcuvw", "xyzuvw"
INCH = 25.4  # millimetres
ROUNDING = 5.1e-5  # by how much a number with four decimals may be off, with room for those of the parameter


def take(now, change):
    """Takes over what is told, and returns what of it is new: of an indexed field the places that have changed."""
    changed = {}
    for field, value in change.items():
        if field in INDEXED:
            known = now.setdefault(field, {})
            new = {index: own for index, own in value.items() if index not in known or known[index] != own}
            known |= new
            if new:
                changed[field] = new
        elif field not in now or now[field] != value:
            now[field] = changed[field] = value
    return changed


def put(now, events, change):
    """Takes over settings; an event only where that changes something, and one for what changes between two effects."""
    changed = take(now, change)
    if changed and events and "set" in events[-1]:
        take(events[-1]["set"], changed)
    elif changed:
        events.append({"set": changed})


def position(axes, numbers):
    """A position by the letters of its axes; those at zero are left out."""
    return {axis: number for axis, number in zip(axes, numbers) if number}


class Lengths:
    """Settings that are lengths. The calls print them once, in the unit that is active then; the vocabulary shows them in the one that is active
    now."""

    def __init__(self):
        self.unit, self.told = "mm", {}

    def tell(self, **lengths):
        """Lengths that were set, numbers or positions."""
        self.told |= {field: (length, self.unit) for field, length in lengths.items()}
        return lengths

    def feed(self, rate, mode):
        """F was set. Under inverse time it is no length."""
        if mode == "inverse_time":
            self.feed_is_no_length()
            return {"feed_rate": rate}
        return self.tell(feed_rate=rate)

    def feed_is_no_length(self):
        self.told.pop("feed_rate", None)

    def precise_feed(self, shown):
        """F as a parameter shows it, with more decimals than the call has; where they differ by more than those, the parameter means something
        else."""
        rate, unit = self.told.get("feed_rate", (None, None))
        if unit == self.unit and abs(rate - shown) <= ROUNDING:
            self.tell(feed_rate=shown)

    def use_unit(self, unit):
        """Another unit: every length, in that unit."""
        self.unit = unit
        return {field: self.here(length, was) for field, (length, was) in self.told.items()}

    def here(self, length, was):
        if isinstance(length, dict):
            return {axis: self.here(number, was) if axis in LINEAR else number for axis, number in length.items()}
        return length if was == self.unit else length * INCH if was == "inch" else length / INCH
