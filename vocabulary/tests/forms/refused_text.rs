//! Texts that are not in the form: each is refused with one message that has its line.

use gaugeblock_vocabulary::{Outcome, Scenario};

/// Checks that each outcome, which is right but for one line, is refused with this message.
#[track_caller]
fn refused(head: &str, tail: &str, rows: &[(&str, &str)]) {
    let line = head.lines().count() + 1;
    for (wrong, message) in rows {
        let text = format!("{head}{wrong}\n{tail}");
        let error = Outcome::from_text(&text).expect_err(&text);
        assert_eq!(error.to_string(), format!("line {line}: {message}"), "in:\n{text}");
    }
}

const HEAD: &str = "gaugeblock outcome 0\nlanguage rs274\nstart units=mm\n";
const END: &str = "end program_end\n";

#[test]
fn beginning() {
    refused(
        "",
        END,
        &[
            ("gaugeblock outcome 1", "the first line must be: gaugeblock outcome 0"),
            ("language rs274", "the first line must be: gaugeblock outcome 0"),
        ],
    );
    refused(
        "gaugeblock outcome 0\n",
        END,
        &[
            ("language basic", "basic is none of rs274, nct, gpp"),
            ("language", " is none of rs274, nct, gpp"),
            ("stop", "no line begins with stop"),
        ],
    );
    refused(
        "gaugeblock outcome 0\nblock main.ngc:1\n",
        END,
        &[("state motion=feed", "the language line must come first")],
    );
}

#[test]
fn order_of_lines() {
    refused(
        HEAD,
        END,
        &[
            ("language rs274", "a second language line"),
            ("start", "a second start line"),
            ("set feed_rate=1", "this belongs below a block line"),
            ("do pallet_shuttle", "this belongs below a block line"),
            ("state", "this belongs below a block line"),
        ],
    );
    refused(
        &format!("{HEAD}block main.ngc:1\nstate motion=feed\n"),
        END,
        &[
            ("state motion=feed", "a second state line"),
            ("set feed_rate=1", "the state is the last line below a block line"),
            ("do pallet_shuttle", "the state is the last line below a block line"),
        ],
    );
    refused(
        &format!("{HEAD}block main.ngc:1\n{END}parameters\n"),
        "",
        &[
            ("end aborted", "a second end line"),
            ("parameters 1=1", "a second parameters line"),
            ("block main.ngc:2", "a block after the end"),
            ("do pallet_shuttle", "this belongs below a block line"),
        ],
    );
}

#[test]
fn missing_lines() {
    let missing = |text: &str| Outcome::from_text(text).expect_err(text).to_string();
    assert_eq!(missing(""), "line 1: the language line is missing");
    assert_eq!(missing("gaugeblock outcome 0\n"), "line 1: the language line is missing");
    assert_eq!(
        missing("gaugeblock outcome 0\nlanguage gpp\n"),
        "line 2: the start line is missing"
    );
    assert_eq!(missing(HEAD), "line 3: the end line is missing");
}

#[test]
fn blocks_and_records() {
    refused(
        HEAD,
        END,
        &[
            ("block main.ngc", "not a block like main.ngc:3: main.ngc"),
            ("block main.ngc:", "not a block like main.ngc:3: main.ngc:"),
            ("block main.ngc:-1", "not a block like main.ngc:3: main.ngc:-1"),
            ("block main.ngc:4294967296", "not a block like main.ngc:3: main.ngc:4294967296"),
            ("block \"main.ngc\" :1", "not a block like main.ngc:3: \"main.ngc\" :1"),
            ("block \"main.ngc:1", "not a text in double quotes: \"main.ngc:1"),
        ],
    );
    refused(
        &format!("{HEAD}block main.ngc:1\n"),
        END,
        &[
            ("set colour=red", "there is no field named colour"),
            ("set motion=feed", "there is no field named motion"),
            ("set units=furlong", "furlong is none of inch, mm"),
            ("set units", "expected name=value, found: units"),
            ("set units=mm plane", "expected name=value, found: plane"),
            ("set units=mm =3", "expected name=value, found: =3"),
            ("set feed_rate=fast", "not a number: fast"),
            ("set feed_rate=infinity", "not a number: infinity"),
            ("set feed_rate=nan", "not a number: nan"),
            ("set feed_rate=1e999", "not a number: 1e999"),
            ("set feed_rate=1 feed_rate=2", "this occurs twice in the line: feed_rate"),
            ("set feed_rate[0]=1", "no index belongs here: [0]"),
            ("set spindle=stopped", "an index is missing, as in name[0]"),
            ("set spindle[0=stopped", "expected name=value, found: [0=stopped"),
            ("set spindle[main]=stopped", "not an index of this field: main"),
            ("set spindle[256]=stopped", "not an index of this field: 256"),
            ("set spindle[00]=stopped", "not an index of this field: 00"),
            ("set spindle[0]=off spindle[0]=off", "this occurs twice in the line: spindle"),
            ("set work_offset=1.5", "not a whole number that fits here: 1.5"),
            ("set work_offset=-1", "not a whole number that fits here: -1"),
            ("set tool_offset=1", "the parentheses are missing in a position like (x1 y2): 1"),
            ("set tool_offset=(x1", "a quote or parenthesis is not closed: (x1"),
            ("set tool_offset=(x)", "not a number: "),
            ("set tool_offset=(q1)", "q is none of x, y, z, a, b, c, u, v, w"),
            ("set tool_offset=(x1 x2)", "an axis occurs twice in a position like (x1 y2): (x1 x2)"),
            ("set tool_offset=(x1)mm", "expected name=value, found: mm"),
            ("state local[1.1]=vacant", "there is no field named local"),
            ("state parameter=1", "an index is missing, as in name[0]"),
            ("state parameter[\"x]=1", "expected name=value, found: [\"x]=1"),
        ],
    );
}

#[test]
fn effects() {
    refused(
        &format!("{HEAD}block main.ngc:1\n"),
        END,
        &[
            ("do", "there is no effect named "),
            ("do fly", "there is no effect named fly"),
            ("do straight_feed", "argument end: it is missing"),
            ("do straight_feed end=(x1) speed=2", "unknown argument speed"),
            ("do straight_feed end[0]=(x1)", "argument end: it is missing"),
            ("do stop optional=true", "argument optional: neither yes nor no: true"),
            ("do dwell seconds=", "argument seconds: not a number: "),
            (
                "do log_open file=a.log append=yes",
                "argument file: not a text in double quotes: a.log",
            ),
            (
                "do log_open file=\"a append=yes",
                "a quote or parenthesis is not closed: \"a append=yes",
            ),
            (
                "do prepare_tool tool=2147483648",
                "argument tool: not a whole number that fits here: 2147483648",
            ),
            (
                "do message channel=radio text=\"a\"",
                "argument channel: radio is none of display, print, log, output",
            ),
        ],
    );
}

#[test]
fn ends_parameters_pins_samples() {
    refused(
        HEAD,
        "",
        &[
            ("end", "no run ends as "),
            ("end well", "no run ends as well"),
            ("end program_end now", "expected name=value, found: now"),
            ("end program_end at=1", "unknown argument at"),
            ("end fault", "argument message: it is missing"),
            ("end fault file=\"main.ngc\" message=\"\"", "one without the other: file and line"),
            ("end fault from=1 message=\"\"", "one without the other: from and to"),
            ("end budget_exhausted", "argument bound: it is missing"),
            ("end unsupported file=\"main.ngc\" line=1", "argument what: it is missing"),
            ("end unspecified file=\"main.ngc\" why=\"\"", "argument line: it is missing"),
            ("parameters 31", "expected name=value, found: 31"),
            ("parameters x=1", "not an index of this field: x"),
            ("parameters 31[0]=1", "no index belongs here: [0]"),
            ("pin digital_out[0]", "argument time: it is missing"),
            ("pin digital_out[0] time=1", "argument value: it is missing"),
            ("pin coolant_mist time=1 value=2 unit=3", "unknown argument unit"),
            ("sample time=1", "argument position: it is missing"),
            ("sample time=1 position=(x1) speed=2", "unknown argument speed"),
        ],
    );
}

#[test]
fn pins() {
    let known = "digital_out[n], analog_out[n], spindle_on[n], spindle_forward[n], spindle_reverse[n], \
                 spindle_speed[n], spindle_brake[n], spindle_locked[n], spindle_orient[n], spindle_orient_angle[n], \
                 spindle_orient_mode[n], coolant_mist, coolant_flood";
    let wrong = [
        "horn",
        "digital_out",
        "digital_out[]",
        "digital_out[00]",
        "digital_out[-1]",
        "digital_out[65536]",
        "digital_out[0",
        "coolant_mist[0]",
        "coolant_mist]",
    ];
    for pin in wrong {
        let line = format!("pin {pin} time=1 value=1");
        refused(HEAD, END, &[(&line, &format!("{pin} is none of {known}"))]);
    }
}

/// A person may write what `to_text` would not: blank lines, other indentation, names in quotes.
#[test]
fn loosely_written() {
    let text = "\r\ngaugeblock outcome 0\r\n language gpp \n\nstart\n block \"a.ngc\":1\n\tset   feed_rate=+1.50  \nend aborted";
    let tidy = "gaugeblock outcome 0\nlanguage gpp\nstart\nblock a.ngc:1\n  set feed_rate=1.5\nend aborted\n";
    assert_eq!(Outcome::from_text(text).map(|outcome| outcome.to_text()), Ok(tidy.to_owned()));
}

#[test]
fn scenarios() {
    let rows = [
        ("[program\n", 1),
        ("[program]\nmain = \"\"\"m2\n", 3),
        ("\n[machine]\ncolour = \"red\"\n", 3),
        ("[machine]\nspindles = 1\nspindles = 2\n", 3),
        ("[machine]\nspindles = 256\n", 2),
        ("[machine]\nspindles = \"one\"\n", 2),
        ("[machine]\nlength_unit = \"furlong\"\n", 2),
        ("[machine]\n\naxes = [\"x\", \"q\"]\n", 3),
        ("[machine]\norient_offset = nan\n", 2),
        ("[machine.parameters]\n5220 = 1\n5221 = -inf\n", 3),
        ("[machine.parameters]\n05220 = 1.0\n", 2),
        ("[[machine.tools]]\nnumber = 1\n[[machine.tools]]\ndiameter = inf\n", 4),
        ("[budget]\nsteps = -1\n", 2),
        ("[environment]\nprobe = \"sometimes\"\n", 2),
        ("[[operator]]\naction = \"pause\"\n", 1),
        ("[options]\n\"a.b\" = 1\n", 2),
    ];
    for (text, line) in rows {
        let error = Scenario::from_text(text).expect_err(text);
        assert_eq!(error.line, Some(line), "in:\n{text}\nsays {error}");
        let message = &error.message;
        assert!(!message.is_empty() && !message.contains('\n'), "one line of message:\n{message}");
    }
}
