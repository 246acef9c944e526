//! What a person reads: the page of a campaign, and the page of a program.

use std::fmt::Write as _;

use gaugeblock_vocabulary::scenario::{AxisLimits, Start, ToolChange};
use gaugeblock_vocabulary::{Axis, Machine, Position, Program, Scenario, Tool};

use super::{BLOCKS, CONTROL, Manifest, OPERATOR, Question, SAMPLES, SHEET};

/// The page of a campaign.
pub fn readme(manifest: &Manifest) -> String {
    let count = manifest.programs.len();
    let left_out: usize = manifest.left_out.values().sum();
    let mut text = format!(
        "# {count} programs for your control

Each numbered folder has one small program. Run it on your control, write down what you see, and send the folder back.
A memory stick and a pencil are enough. The folders do not contain the expected results, on purpose. Write down what you
see, and not what you think is right.

**The programs are not made for your machine.** They move far, turn the spindle and change tools without regard for travel,
tool or workpiece. Run them on a simulator of the control, or with axes and spindle locked and with neither tool nor
workpiece in the machine.

## Once

1. Fill in `{CONTROL}`: the name of the control, its version, and the last digit of its display.
2. Set the machine up as follows. The page of a program lists what it needs differently; programs with the same set-up
   follow one another.

   * axes X Y Z A B C, without limits; homed, so that all machine positions are 0
   * lengths that are stored (tool table, offsets, stored variables) are millimetres
   * one spindle; four digital and four analog inputs and outputs
   * an empty tool table; no tool in the spindle; a tool change needs no person, and moves no axis
   * no offsets: all of G54 to G59.3, G92 and the tool length are 0; G28 and G30 are at 0
   * all variables that the control keeps are 0
   * all inputs are off; overrides are at 100 %; optional stop and block delete are off
   * subprograms in both styles work (O-words; M98 and M99)

## For each folder, in any order

1. Read `{OPERATOR}`.
2. Bring the control into its state after power-on: no modes, offsets or variables of the program before. If your control
   keeps them, reset them by hand.
3. Load `main.ngc` and the other programs in the folder under the same names, and press cycle start.
4. Fill in `{SHEET}`, with any text editor, or on paper first. Only `ended` is required. **Leave empty what you do not
   know**: it is then not judged, and counts neither for nor against the control.

If you have more time, run a program block by block. Write one line into `{BLOCKS}` for each executed block: the file, the
line in it (from 1), and the position on the display after it, such as `main.ngc,3,10.0,0,0,0,0,0`. For lines with O-words,
M98 and M99, write only the file and the line: `main.ngc,4`. Leave out lines that have only comments. Write all blocks or
none: a list with gaps is judged as the list of what was executed.

The last folders may need a record of the axes instead (`{SAMPLES}`); their pages say how.

You need not run them all. A sheet that is not filled in counts as not run: neither for nor against the control.

## Then

```sh
gaugeblock certify --controller offline:THIS-FOLDER --report report
```

reports what was judged, rule by rule. Do not change the programs or `manifest.json`: an answer to a changed program is
not judged.

## Source of the programs

Suite {} of gaugeblock {}, edition {}, {}.
",
        &manifest.suite[..12.min(manifest.suite.len())],
        manifest.gaugeblock_version,
        manifest.edition,
        manifest.requested(),
    );
    if left_out > 0 {
        // Writing to a string cannot fail.
        let _never = writeln!(
            text,
            "\nCases of it that cannot be run in this way: {left_out}.\n\n| cases | because |\n| --- | --- |"
        );
        for (why, count) in &manifest.left_out {
            let _never = writeln!(text, "| {count} | {why} |");
        }
    }
    text
}

/// The page of a program.
pub fn operator(question: &Question) -> String {
    let Question { exported, scenario, limits } = question;
    let mut set_up = set_up(scenario);
    for (axis, limit) in limits.iter().flat_map(|limits| &limits.axes) {
        let unit = if matches!(axis, Axis::A | Axis::B | Axis::C) { "degrees" } else { "mm" };
        let axis = axis.word().to_uppercase();
        set_up.push(format!("axis {axis}, in {unit}: {}", limits_of(*limit)));
    }
    let mut text = format!("# Program {} ({})\n\n## Set up\n\n", exported.folder, exported.chapter);
    if set_up.is_empty() {
        text.push_str("As the README says.\n");
    } else {
        text.push_str("As the README says, except:\n\n");
        for line in &set_up {
            let _never = writeln!(text, "* {line}");
        }
    }
    text.push_str("\n## Run\n\n");
    let Program { files, start, .. } = &scenario.program;
    let (there, elsewhere): (Vec<&str>, Vec<&str>) =
        files.keys().map(String::as_str).partition(|name| !name.starts_with("elsewhere/"));
    if !there.is_empty() {
        let _never = writeln!(
            text,
            "* Load these where the control looks for subprograms, under these names: {}",
            listed(&there)
        );
    }
    if !elsewhere.is_empty() {
        let _never = writeln!(
            text,
            "* Put these where the control does not look for subprograms: {}",
            listed(&elsewhere)
        );
    }
    text.push_str(match start {
        Start::Program => {
            "* Load `main.ngc`, press cycle start, and touch nothing more until the program has ended, has raised an alarm, or waits for you.\n"
        }
        Start::Mdi => {
            "* Enter the lines of `main.ngc` by hand (MDI), one after the other, each when the one before is done. Stop at an alarm.\n"
        }
    });
    if let Some(limits) = limits {
        text.push_str(&bring_back(limits.period));
        return text;
    }
    text.push_str(
        "* If it waits for cycle start: that is how it ended (`waiting`). Do not press it again.\n",
    );
    let _never = writeln!(
        text,
        "\n## Write down, in `{SHEET}`\n\n* how it ended; after an alarm its text, and its line"
    );
    let axes: Vec<_> = exported.axes.iter().map(|axis| axis.word().to_uppercase()).collect();
    let _never = writeln!(
        text,
        "* unless it ended in an alarm: the position, in program coordinates: {}",
        axes.join(" ")
    );
    if !exported.variables.is_empty() {
        let variables: Vec<_> =
            exported.variables.iter().map(|variable| format!("#{variable}")).collect();
        let _never = writeln!(text, "* what is in these variables: {}", variables.join(" "));
    }
    if exported.messages {
        text.push_str("* its messages, on the display, printed or logged, in order\n");
    }
    text
}

/// What a person reads whose control records its axes.
fn bring_back(period: f64) -> String {
    format!(
        "
## Bring back

Let the control record the commanded position of each axis, from before the start until the axes rest. Best is one row per
cycle of its position control (every {period} s on the machine with these limits). Write the record as `{SAMPLES}`:

```
# gaugeblock samples 0 period=0.001 resolution=0.0001
x,y,z
0,0,0
0.0001,0,0
```

`period` is the time from one row to the next, in seconds; `resolution` is the error of a recorded position. The second line
names the axes. Positions are machine coordinates, in millimetres and degrees. If your control cannot record, write so into
`{SHEET}`.\n"
    )
}

fn listed(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// What is not as usual.
fn set_up(scenario: &Scenario) -> Vec<String> {
    let usual = Machine::default();
    let Machine {
        length_unit,
        axes,
        limits,
        spindles,
        digital_io,
        analog_io,
        orient_offset,
        tool_change,
        random_tool_changer,
        fanuc_subs,
        tools,
        parameters,
        ini,
    } = &scenario.machine;
    let mut lines = Vec::new();
    let mut say = |is_said: bool, line: String| {
        if is_said {
            lines.push(line);
        }
    };
    say(
        *length_unit != usual.length_unit,
        "lengths that are stored (tool table, offsets, stored variables, limits) are inches"
            .to_owned(),
    );
    let names: Vec<_> = axes.iter().map(|axis| axis.word().to_uppercase()).collect();
    say(*axes != usual.axes, format!("the axes are {}", names.join(" ")));
    for (axis, limit) in limits {
        say(true, format!("axis {}: {}", axis.to_uppercase(), limits_of(*limit)));
    }
    say(*spindles != usual.spindles, format!("{spindles} spindles"));
    say(
        (*digital_io, *analog_io) != (usual.digital_io, usual.analog_io),
        format!("{digital_io} digital and {analog_io} analog inputs and outputs"),
    );
    say(*orient_offset != 0.0, format!("{orient_offset} degrees are added to every angle of M19"));
    let ToolChange { at_g30, quill_up, with_spindle_on } = *tool_change;
    say(at_g30, "a tool change moves to the point of G30 first".to_owned());
    say(quill_up, "a tool change retracts Z first".to_owned());
    say(with_spindle_on, "a tool change leaves the spindle turning".to_owned());
    say(*random_tool_changer, "tools change places in the changer".to_owned());
    say(!fanuc_subs, "M98 and M99 are switched off".to_owned());
    for tool in tools {
        say(true, format!("tool table: {}", tool_line(tool)));
    }
    for (number, value) in parameters.0.iter() {
        say(true, format!("stored variable #{number} = {value}"));
    }
    for (name, value) in ini {
        say(true, format!("entry {name} of the INI file = {value}"));
    }
    for change in &scenario.environment.inputs {
        say(true, format!("input {} is {} before the start", change.input, change.value));
    }
    say(scenario.program.block_delete, "block delete is on".to_owned());
    lines
}

fn limits_of(limits: AxisLimits) -> String {
    let AxisLimits { minimum, maximum, velocity, acceleration, jerk } = limits;
    let said = [
        ("lowest position", minimum),
        ("highest position", maximum),
        ("highest speed per second", velocity),
        ("highest acceleration per second squared", acceleration),
        ("highest jerk per second cubed", jerk),
    ];
    let said = said.iter().filter_map(|(what, value)| Some(format!("{what} {}", (*value)?)));
    said.collect::<Vec<_>>().join(", ")
}

fn tool_line(tool: &Tool) -> String {
    let Tool { number, pocket, offset, diameter, front_angle, back_angle, orientation } = tool;
    let mut line = format!("T{number}, pocket {}", pocket.unwrap_or(*number));
    if *offset != Position::default() {
        let _never = write!(line, ", offset {offset}");
    }
    for (what, value) in
        [("diameter", diameter), ("front angle", front_angle), ("back angle", back_angle)]
    {
        if *value != 0.0 {
            let _never = write!(line, ", {what} {value}");
        }
    }
    if *orientation != 0 {
        let _never = write!(line, ", orientation {orientation}");
    }
    line
}
