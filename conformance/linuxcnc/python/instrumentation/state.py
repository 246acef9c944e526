"""What a checkpoint shows, in the fields of the vocabulary."""
from .settings import position

PLANES = {170: "xy", 180: "zx", 190: "yz", 171: "uv", 181: "wu", 191: "vw"}
COMPENSATION = {400: "off", 410: "left", 411: "left", 420: "right", 421: "right"}
MOTIONS = {
    0: "traverse", 10: "feed", 20: "arc_cw", 30: "arc_ccw", 50: "cubic_spline", 51: "quadratic_spline", 52: "nurbs",
    330: "spindle_synchronised", 331: "rigid_tap", 382: "probe_toward_error", 383: "probe_toward", 384: "probe_away_error", 385: "probe_away",
    730: "cycle_73", 740: "cycle_74", 760: "thread_76", 810: "cycle_81", 820: "cycle_82", 830: "cycle_83", 840: "cycle_84", 850: "cycle_85",
    860: "cycle_86", 870: "cycle_87", 880: "cycle_88", 890: "cycle_89",
    800: "none", -1: "none"}  # after G5.3 no code is active


def modes(checkpoint, was, block):
    """Settings that canonical calls do not show, or show only in part. `was` is what was in force before, `block` the code of the block."""
    shown = checkpoint.modes
    distance = lambda name: "absolute" if shown[name] else "incremental"
    per = "per_minute" if shown["_units_per_minute"] else "per_revolution"
    return {
        "plane": PLANES[shown["_plane"]], "distance": distance("_absolute"), "arc_distance": distance("_ijk_absolute_mode"),
        "feed_mode": "inverse_time" if shown["_inverse_time"] else per, "retract": "old_z" if shown["_retract_old_z"] else "r_plane",
        "lathe": "diameter" if shown["_lathe_diameter_mode"] else "radius",
        "compensation": compensation(COMPENSATION[shown["_ccomp"]], was.get("compensation"), block)}


def compensation(side, was, block):
    """Compensation on a side, static or dynamic by the block's code or by what was in force before it: no parameter tells."""
    dynamic = f"dynamic_{side}"
    return dynamic if side != "off" and (was == dynamic or "g41.1" in block or "g42.1" in block) else side


def others(checkpoint):
    """Settings that parameters show of the first spindle and of the rest, beside the modes: all that is known before the first block."""
    shown = checkpoint.modes
    switch = lambda name: "on" if shown[name] else "off"
    turn = "clockwise" if shown["_spindle_cw"] else "counterclockwise"
    return {
        "units": "mm" if shown["_metric"] else "inch", "feed_rate": checkpoint.numbers["_feed"], "mist": switch("_mist"), "flood": switch("_flood"),
        "feed_override": switch("_feed_override"), "adaptive_feed": switch("_adaptive_feed"), "feed_stop": switch("_feed_hold"),
        "speed_override": {"0": switch("_speed_override")}, "spindle": {"0": turn if shown["_spindle_on"] else "stopped"},
        "spindle_mode": {"0": "surface_speed" if shown["_spindle_css_mode"] else "rpm"}, "spindle_speed": {"0": checkpoint.numbers["_rpm"]}}


def point(checkpoint):
    """The controlled point; U, V and W do not exist on this controller."""
    return position("xyzabc", (checkpoint.numbers[f"_{axis}"] for axis in "xyzabc"))


def state(checkpoint, tool):
    """The state after a block, as far as it is shown. The tool comes from the calls: its parameter keeps an old value."""
    shown = checkpoint.modes
    # T0 selects no tool, since tools do not change places here; once one was selected it shows as tool 0.
    is_selected = shown["_selected_pocket"] != -1 and shown["_selected_tool"] != 0
    return {
        "motion": MOTIONS[shown["_motion_mode"]], "position": point(checkpoint), "tool": tool,
        "prepared_tool": shown["_selected_tool"] if is_selected else -1, "call_level": abs(shown["_call_level"]),
        "parameter": dict(checkpoint.parameters)}
