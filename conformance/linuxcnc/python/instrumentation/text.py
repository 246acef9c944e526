"""The little that must be known of a program's text: which lines can jump, end or reach the host, and which parameters are named."""
import enum
import re

MAIN = "main.ngc"
LAST_PARAMETER = 5601  # the highest number that a parameter file may list
DEBUG_SWITCH = 5599  # silences (DEBUG,…); on from the start


class Form(enum.Enum):
    """What kind of block a line holds, as far as it matters for observing it."""

    EMPTY = "nothing but blanks and comments"
    PERCENT = "a percent sign"
    CALL = "an O-word that calls, or M98"
    CONTROL = "any other O-word"
    RETURN = "M99"
    END = "M2 or M30"
    OTHER = "anything else"


class Source:
    """A program as the controller gets it: names and lines of its files, the main program first. A place is a file's index and a line, from 1."""

    def __init__(self, program):
        texts = [(MAIN, program["main"]), *sorted(program.get("files", {}).items())]
        self.files = [(name, lines_of(text)) for name, text in texts]
        compacts = [compact(line) for _, _, line in self.all()]
        self.numbered = {int(number) for text in compacts for number in re.findall(r"#([0-9]+)", text)}
        self.assigned = {int(number) for text in compacts for number in re.findall(r"#([0-9]+)=", text)}
        self.named = {name for text in compacts for name in re.findall(r"#<([^>#]*)>", text)}
        self.computes_numbers = any(re.search(r"#(?![0-9<])", text) for text in compacts)

    def all(self):
        for file, (_, lines) in enumerate(self.files):
            for number, line in enumerate(lines, 1):
                yield file, number, line

    def line(self, place):
        file, number = place
        lines = self.files[file][1]
        return lines[number - 1] if 1 <= number <= len(lines) else ""

    def block(self, place):
        file, number = place
        return {"file": self.files[file][0], "line": number}

    def only_line(self, text):
        """The only place with this text, blanks at its ends aside."""
        found = [(file, number) for file, number, line in self.all() if line.strip() == text.strip()]
        return found[0] if len(found) == 1 else None

    def listed(self):
        """The parameters that the parameter file must list to be seen at the end: all, where numbers are computed."""
        if self.computes_numbers:
            return set(range(1, LAST_PARAMETER + 1))
        return {*range(1, 31), DEBUG_SWITCH} | {number for number in self.numbered if 1 <= number <= LAST_PARAMETER}

    def names_line(self):
        """Whether it asks for line numbers, which checkpoints change."""
        return any("#<_line>" in compact(line) for _, _, line in self.all())

    def may_compensate(self):
        """Whether a block may switch cutter compensation on: one has its code, or a code that is computed."""
        has_code = any(re.search("g[+0]*4[12]", without_names(code(line))) for _, _, line in self.all())
        return has_code or self.computes_word("g")

    def names_hal(self):
        return any(name in compact(line) for _, _, line in self.all() for name in ("_hal[", "hal_pin_vars"))

    def has_g_code(self, *codes):
        """Whether a line has one of these, written plainly and in lower case, such as `g38.2`."""
        wanted = re.compile("|".join(f"{re.escape(code)}(?![0-9.])" for code in codes))
        return any(wanted.search(code(line)) for _, _, line in self.all())

    def computes_word(self, letter):
        """Whether the value of a letter is computed somewhere: behind it stands no plain number."""
        computed = re.compile(letter + r"[-+]*[#\[acerst]")
        codes = [without_names(code(line)) for _, _, line in self.all()]
        return any(computed.search(text) for text in codes if not text.startswith("o"))

    def pauses(self):
        """Whether a block has M0 or M60, which would stop until someone resumes; not one that is refused for two such codes."""
        stops = [[number for number in m_codes(code(line)) if number in (0, 1, 2, 30, 60)] for _, _, line in self.all()]
        return [0] in stops or [60] in stops

    def reaches_host(self):
        """Whether a line runs Python, or looks for a sub outside of the folder."""
        texts = [compact(line) for _, _, line in self.all()]
        return any(re.search(r"[(;]py|^((?!o<).)*o<[^>]*[/\\]", text) for text in texts)

    def shows_open_name(self):
        """Whether a message ends within the name of a parameter: `(print,a#)`, `(debug,#<x)`."""
        for _, _, line in self.all():
            keyword, comma, text = (last_comment(line) or "").partition(",")
            if comma and compact(keyword) in ("debug", "print", "log", "abort") and re.search(r"#(<[^>]*)?$", text):
                return True
        return False


def lines_of(text):
    """Lines without their ends; text after the last line break counts if there is any."""
    lines = text.split("\n")
    return [line.rstrip("\r") for line in (lines if lines[-1] else lines[:-1])]


def compact(line):
    """Without blanks, in lower case: how the interpreter reads a line."""
    return "".join(line.split()).lower()


def code(line):
    """The same without comments."""
    return compact(re.sub(r"\([^)]*\)?|;.*", "", line))


def without_names(text):
    """Without what stands between `<` and `>`."""
    return re.sub(r"<[^<>]*>?", "", text)


def m_codes(text):
    """Numbers that directly follow an M."""
    return [int(number) for number in re.findall(r"m([0-9]+)", without_names(text))]


def plain_word(text, letter):
    """The value of a word that is written as a plain number in a line's code."""
    found = re.search(letter + r"([-+]?([0-9]+\.?[0-9]*|\.[0-9]+))(?![0-9.])", without_names(text))
    return float(found[1]) if found else None


def last_comment(line):
    """The text of the last comment in parentheses."""
    _, opened, rest = line.rpartition("(")
    text, closed, _ = rest.partition(")")
    return text if opened and closed else None


def has_slash(line):
    """Whether a line would be skipped under block delete."""
    return line.lstrip().startswith("/")


def without_number(line):
    """A line without the slash and the line number at its beginning."""
    line = line.lstrip().removeprefix("/").lstrip()
    return re.sub(r"^[nN][0-9.\s]*", "", line)


def opens_probe_log(line):
    """Whether a line opens or closes the file for probed points; None where it does neither. No call tells of these."""
    comment = compact(last_comment(line) or "")
    return True if comment.startswith("probeopen") else False if comment == "probeclose" else None


def form(line):
    """What kind of block a line holds."""
    is_numbered, text = re.fullmatch(r"/?(n[0-9.]*)?(.*)", code(line), re.S).groups()
    if not text:
        return Form.EMPTY if is_numbered is None and opens_probe_log(line) is None else Form.OTHER
    if text.startswith("%"):
        return Form.PERCENT
    if text.startswith("o"):
        return Form.CALL if "call" in re.sub(r"^o<[^>]*>?", "", text) else Form.CONTROL
    codes = m_codes(text)
    if 98 in codes:
        return Form.CALL
    if 2 in codes or 30 in codes:
        return Form.END
    return Form.RETURN if 99 in codes else Form.OTHER
