"""The files of the machine, and rs274 as a process: a folder of its own, a clean environment, bounds, and nothing left behind."""
import contextlib
import fcntl
import os
import re
import resource
import subprocess
import tempfile
import typing

from .settings import AXES

MACHINE, TOOLS, PARAMETERS = "machine.ini", "tools.tbl", "parameters.var"
PRINTED = "printed"
SECONDS, BYTES = 5, 16 << 20

# Others leave entries in the memory of HAL, of which it complains.
COMPLAINT = re.compile("HAL: ERROR: .* component")

# What is started writes no more than this into a file: a program that does not end would fill the disk.
resource.setrlimit(resource.RLIMIT_FSIZE, (BYTES, BYTES))


class Ran(typing.NamedTuple):
    """What a run left: its exit status, None where it was ended; both outputs; numbered parameters that are not zero."""

    status: int | None
    printed: str
    errors: str
    parameters: dict[int, float]


def start(scenario, source, texts, has_hal, *how, typed=""):
    """Runs rs274 with these texts in place of the program's files."""
    # On a disk, creating its files is a good part of a short run.
    memory = "/dev/shm" if os.path.isdir("/dev/shm") and "TMPDIR" not in os.environ else None
    with tempfile.TemporaryDirectory(prefix="gaugeblock-rs274-", dir=memory) as folder:
        write(folder, scenario.get("machine", {}), source, texts, has_hal)
        command = ["rs274", "-g", "-i", MACHINE, "-t", TOOLS, "-v", PARAMETERS, *how]
        command += ["-b"] if scenario["program"].get("block_delete") else []
        clean = {"HOME": folder, "LC_ALL": "C", "PATH": os.environ["PATH"]}
        with open(os.path.join(folder, PRINTED), "w+b") as printed:
            try:
                done = subprocess.run([*command, source.files[0][0]], cwd=folder, env=clean, timeout=SECONDS, input=typed.encode(),
                                      stdout=printed, stderr=subprocess.PIPE)
            except subprocess.TimeoutExpired:
                return Ran(None, "", "", {})
            if printed.seek(0, os.SEEK_END) >= BYTES:
                return Ran(None, "", "", {})
            printed.seek(0)
            text = printed.read().decode(errors="replace")
        errors = done.stderr.decode(errors="replace").split("\n")
        errors = "\n".join(line for line in errors if not COMPLAINT.match(line))
        if done.returncode not in (0, 1):
            raise ChildProcessError(f"rs274 exited with {done.returncode}: {errors[-300:]}")
        with open(os.path.join(folder, PARAMETERS)) as file:
            pairs = [line.split() for line in file if line.strip()]
        return Ran(done.returncode, text, errors, {int(number): float(value) for number, value in pairs if float(value)})


@contextlib.contextmanager
def hal(source):
    """Whether the program names HAL, whose memory is one for the whole machine: it has it to itself. Others do without."""
    names = source.names_hal()
    with contextlib.ExitStack() as held:
        if names:
            file = held.enter_context(open(os.path.join(tempfile.gettempdir(), "gaugeblock-hal.lock"), "a"))
            fcntl.flock(file, fcntl.LOCK_EX)
        yield names


def write(folder, machine, source, texts, has_hal):
    def put(name, content):
        path = os.path.join(folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", newline="") as file:
            file.write(content)

    put(MACHINE, ini(machine, has_hal))
    put(TOOLS, "\n" + "".join(map(tool_line, machine.get("tools", []))))
    # Only what the file lists is written back.
    values = dict.fromkeys(source.listed(), 0) | {5220: 1}
    values |= {int(number): value for number, value in machine.get("parameters", {}).items()}
    put(PARAMETERS, "".join(f"{key}\t{number(value)}\n" for key, value in sorted(values.items())))
    for (name, _), text in zip(source.files, texts):
        put(name, text)


def ini(machine, has_hal):
    flag = lambda on: "1" if on else "0"
    change = machine.get("tool_change", {})
    sections = {
        "RS274NGC": [
            "SUBROUTINE_PATH=.", f"DISABLE_FANUC_STYLE_SUB={flag(not machine.get('fanuc_subs', True))}",
            f"ORIENT_OFFSET={number(machine.get('orient_offset', 0))}"] + ([] if has_hal else ["HAL_PIN_VARS=0"]),
        "TRAJ": [f"SPINDLES={machine.get('spindles', 1)}"],
        "EMCIO": [f"TOOL_CHANGE_{name.upper()}={flag(change.get(name))}" for name in ("at_g30", "quill_up", "with_spindle_on")]}
    for name, value in machine.get("ini", {}).items():
        section, name = name.removeprefix("[").split("]", 1)
        sections.setdefault(section, []).append(f"{name}={number(value)}")
    return "".join(f"[{section}]\n" + "".join(f"{line}\n" for line in lines) for section, lines in sections.items())


def tool_line(tool):
    """A line of the tool table, whose order is that of the machine's list: the controller names tools by their place in it."""
    pocket = tool["number"] if tool.get("pocket") is None else tool["pocket"]
    offset = "".join(f" {axis.upper()}{number(tool.get('offset', {}).get(axis, 0))}" for axis in AXES)
    angles = f"I{number(tool.get('front_angle', 0))} J{number(tool.get('back_angle', 0))}"
    return f"T{tool['number']} P{pocket}{offset} D{number(tool.get('diameter', 0))} {angles} Q{tool.get('orientation', 0)}\n"


def number(value):
    return int(value) if float(value).is_integer() and abs(value) < 1e15 else value
