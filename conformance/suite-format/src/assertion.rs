//! Assertions: what a person wrote that must be observed.

use std::fmt;
use std::str::FromStr;

use gaugeblock_vocabulary::{
    Effect, End, FaultKind, GppState, Language, NctState, Pin, Rs274State, Settings, State,
    TextError, Value,
    text::{Arguments, FromText},
};

/// A block of a program, and perhaps one of its executions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// File; the main program's when not written.
    pub file: String,
    /// Line, from 1.
    pub line: u32,
    /// Its k-th execution, from 1; the last one when not written.
    pub execution: Option<u32>,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.file != gaugeblock_vocabulary::Program::MAIN {
            write!(f, "{}:", self.file)?;
        }
        write!(f, "{}", self.line)?;
        self.execution.map_or(Ok(()), |execution| write!(f, "@{execution}"))
    }
}

/// A field and the value that it must have, as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expected {
    /// Field name.
    pub field: String,
    /// Index, of a spindle or a parameter.
    pub index: Option<String>,
    /// Value in text form.
    pub value: String,
}

/// A field that a block may change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Field name.
    pub name: String,
    /// Index; all of them when not written.
    pub index: Option<String>,
}

impl Field {
    /// Whether it is this field.
    pub fn covers(&self, name: &str, index: Option<&str>) -> bool {
        self.name == name && (self.index.is_none() || self.index.as_deref() == index)
    }
}

/// What must be observed.
#[derive(Clone, Debug, PartialEq)]
pub enum Claim {
    /// The run ended without a fault.
    Accepted,
    /// It ended by a fault, at this block where one is named.
    Refused(Option<Place>),
    /// The fault's kind.
    Kind(FaultKind),
    /// How it ended, by the end's name.
    Ends(String),
    /// Fields after a block.
    After(Place, Vec<Expected>),
    /// Fields at the end.
    AtEnd(Vec<Expected>),
    /// Settings in force at the k-th effect of a name.
    AtEffect(String, u32, Vec<Expected>),
    /// The effects of a block: one list, or several with any effects between them.
    EffectsAt(Place, Vec<Vec<Effect>>),
    /// A block changes no other fields than these.
    Unchanged(Place, Vec<Field>),
    /// The effects of the whole run, without messages and the program's end.
    Effects(Vec<Effect>),
    /// How many effects of a name.
    Count(String, usize),
    /// The texts of all messages.
    Messages(Vec<String>),
    /// All that a post-processor has printed, joined.
    Output(String),
    /// The warnings of a post-processor, without the word.
    Warnings(Vec<String>),
    /// The values that a pin takes over the whole run, in order, without the one that it had before.
    Pin(Pin, Vec<f64>),
}

/// A claim, and the options or the edition under which it is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Assertion {
    /// `choice = option` or `edition = id`, where it is made under all of these only.
    pub guards: Vec<(String, String)>,
    /// What must be observed.
    pub claim: Claim,
    /// As it was written.
    pub text: String,
}

impl FromStr for Assertion {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let trimmed = text.trim();
        let (guards, rest) = match trimmed.strip_prefix("when ") {
            Some(rest) => {
                let (guards, rest) =
                    rest.split_once(": ").ok_or("after `when choice = option` comes `: `")?;
                (guards.split(" and ").map(guard).collect::<Result<_, _>>()?, rest)
            }
            None => (Vec::new(), trimmed),
        };
        let claim = claim(rest.trim())?;
        Ok(Self { guards, claim, text: trimmed.to_owned() })
    }
}

fn guard(text: &str) -> Result<(String, String), String> {
    let (id, option) = text.split_once('=').ok_or("a guard is `when choice = option: …`")?;
    let (id, option) = (id.trim(), option.trim());
    if [id, option].iter().any(|name| name.is_empty() || name.contains(char::is_whitespace)) {
        return Err(
            "guards are joined by `and`: `when choice = option and choice = option: …`".to_owned()
        );
    }
    Ok((id.to_owned(), option.to_owned()))
}

fn claim(text: &str) -> Result<Claim, String> {
    let (word, rest) = text.split_once(' ').unwrap_or((text, ""));
    let rest = rest.trim();
    match word {
        "accepted" if rest.is_empty() => Ok(Claim::Accepted),
        "refused" if rest.is_empty() => Ok(Claim::Refused(None)),
        "refused" => {
            let place =
                rest.strip_prefix("at ").ok_or("expected `refused` alone or `refused at LINE`")?;
            Ok(Claim::Refused(Some(place_of(place)?)))
        }
        "kind" => Ok(Claim::Kind(FaultKind::from_text(rest).map_err(|error| error.message)?)),
        "ends" => ends(rest),
        "after" => {
            let (place, fields) = rest.split_once(' ').ok_or("`after LINE field = value`")?;
            Ok(Claim::After(place_of(place)?, fields_of(fields)?))
        }
        "at" => {
            let (what, fields) = rest.split_once(' ').ok_or("`at EFFECT@K field = value`")?;
            if what == "end" {
                return Ok(Claim::AtEnd(fields_of(fields)?));
            }
            let (name, count) = what.split_once('@').unwrap_or((what, "1"));
            let count = count.parse().map_err(|_| format!("not a count: {count}"))?;
            Ok(Claim::AtEffect(effect_name(name)?, count, fields_of(fields)?))
        }
        "unchanged" => {
            let rest = rest.strip_prefix("at ").ok_or("`unchanged at LINE but FIELD, FIELD`")?;
            let (place, fields) = match rest.split_once(" but ") {
                Some((place, fields)) => (place, split(fields, ',')),
                None => (rest, Vec::new()),
            };
            let fields = fields.into_iter().map(changed_field).collect::<Result<_, _>>()?;
            Ok(Claim::Unchanged(place_of(place)?, fields))
        }
        "effects:" => Ok(Claim::Effects(effects(rest)?)),
        "effects" => {
            let rest = rest.strip_prefix("at ").ok_or("`effects: …` or `effects at LINE: …`")?;
            let (place, list) = rest.split_once(": ").ok_or("`effects at LINE: …`")?;
            Ok(Claim::EffectsAt(place_of(place)?, effects_with_gaps(list)?))
        }
        "count" => {
            let (name, count) = rest.split_once('=').ok_or("`count EFFECT = K`")?;
            let count = count.trim().parse().map_err(|_| format!("not a count: {count}"))?;
            Ok(Claim::Count(effect_name(name.trim())?, count))
        }
        "messages:" if rest == "none" => Ok(Claim::Messages(Vec::new())),
        "messages:" => {
            Ok(Claim::Messages(rest.split(" | ").map(|m| m.trim().to_owned()).collect()))
        }
        "output:" => Ok(Claim::Output(String::from_text(rest).map_err(|error| error.message)?)),
        "warnings:" if rest == "none" => Ok(Claim::Warnings(Vec::new())),
        "warnings:" => {
            Ok(Claim::Warnings(rest.split(" | ").map(|text| text.trim().to_owned()).collect()))
        }
        "pin" => {
            let (pin, values) = rest.split_once(": ").ok_or("`pin digital_out[0]: 1, 0`")?;
            Ok(Claim::Pin(pin.parse().map_err(|e: TextError| e.message)?, pin_values(values)?))
        }
        _ => Err(format!("no assertion begins with `{word}`")),
    }
}

fn ends(name: &str) -> Result<Claim, String> {
    let name = if name == "budget" { "budget_exhausted" } else { name };
    let known = ["program_end", "percent_end", "endless", "paused", "aborted", "budget_exhausted"];
    if known.contains(&name) {
        Ok(Claim::Ends(name.to_owned()))
    } else {
        Err(format!("a run does not end as `{name}`, but as one of {}", known.join(", ")))
    }
}

fn pin_values(text: &str) -> Result<Vec<f64>, String> {
    if text == "none" {
        return Ok(Vec::new());
    }
    let value = |text: &str| {
        let value = f64::from_text(text.trim())?;
        check_finite(&Value::Number(value)).map(|()| value)
    };
    text.split(',').map(value).collect::<Result<_, _>>().map_err(|error: TextError| error.message)
}

fn effect_name(name: &str) -> Result<String, String> {
    if Effect::NAMES.contains(&name) {
        Ok(name.to_owned())
    } else {
        Err(format!("there is no effect named `{name}`"))
    }
}

fn place_of(text: &str) -> Result<Place, String> {
    let (at, execution) = match text.split_once('@') {
        Some((at, k)) => (at, Some(k.parse().map_err(|_| format!("not an execution: {k}"))?)),
        None => (text, None),
    };
    let (file, line) = at.rsplit_once(':').unwrap_or((gaugeblock_vocabulary::Program::MAIN, at));
    let line = line.parse().map_err(|_| format!("not a line: {line}"))?;
    Ok(Place { file: file.to_owned(), line, execution })
}

/// Splits at a separator outside of parentheses and quotes.
fn split(text: &str, separator: char) -> Vec<&str> {
    let (mut depth, mut quoted, mut start) = (0_u32, false, 0);
    let mut parts = Vec::new();
    for (place, c) in text.char_indices() {
        match c {
            '"' => quoted = !quoted,
            '(' if !quoted => depth += 1,
            ')' if !quoted => depth = depth.saturating_sub(1),
            _ if c == separator && depth == 0 && !quoted => {
                parts.push(text[start..place].trim());
                start = place + c.len_utf8();
            }
            _ => {}
        }
    }
    parts.push(text[start..].trim());
    parts
}

fn fields_of(text: &str) -> Result<Vec<Expected>, String> {
    split(text, ',').into_iter().map(field_of).collect()
}

fn changed_field(text: &str) -> Result<Field, String> {
    let (name, index) = name_and_index(text);
    let of_state = [Rs274State::FIELDS, GppState::FIELDS, NctState::FIELDS].concat();
    if Settings::FIELDS.contains(&name.as_str()) || of_state.contains(&name.as_str()) {
        Ok(Field { name, index })
    } else {
        Err(format!("unknown field `{name}`"))
    }
}

/// The parts of a name such as `spindle[0]` or `#31`.
fn name_and_index(name: &str) -> (String, Option<String>) {
    if let Some(parameter) = name.strip_prefix('#') {
        let inner = parameter.strip_prefix('<').and_then(|rest| rest.strip_suffix('>'));
        ("parameter".to_owned(), Some(inner.unwrap_or(parameter).to_owned()))
    } else if let Some((field, index)) = name.split_once('[') {
        (field.to_owned(), Some(index.trim_end_matches(']').to_owned()))
    } else {
        (name.to_owned(), None)
    }
}

fn field_of(text: &str) -> Result<Expected, String> {
    let (name, value) = text.split_once('=').ok_or(format!("`field = value`, not `{text}`"))?;
    let (name, value) = (name.trim(), value.trim());
    let (field, index) = name_and_index(name);
    let expected = Expected { field, index, value: value.to_owned() };
    expected.check().map_err(|error| format!("{name}: {}", error.message))?;
    Ok(expected)
}

impl Expected {
    /// A language whose state has this field. It has the same type in each that does.
    pub fn language(&self) -> Language {
        let field = self.field.as_str();
        match (Rs274State::FIELDS.contains(&field), GppState::FIELDS.contains(&field)) {
            (true, _) => Language::Rs274,
            (false, true) => Language::Gpp,
            (false, false) => Language::Nct,
        }
    }

    /// Whether field, index and value are readable.
    fn check(&self) -> Result<(), TextError> {
        let index = self.index.as_deref();
        if Settings::FIELDS.contains(&self.field.as_str()) {
            let mut settings = Settings::default();
            settings.read(&self.field, index, &self.value)?;
            return settings.entries().iter().try_for_each(|entry| check_finite(&entry.value));
        }
        let of_state = [Rs274State::FIELDS, GppState::FIELDS, NctState::FIELDS].concat();
        if of_state.contains(&self.field.as_str()) {
            let mut state = State::empty(self.language());
            state.read(&self.field, index, &self.value)?;
            return state.entries().iter().try_for_each(|entry| check_finite(&entry.value));
        }
        Err(TextError::new(format!("there is no field named {}", self.field)))
    }
}

/// No document specifies a number that is not finite.
fn check_finite(value: &Value) -> Result<(), TextError> {
    let is_finite = match value {
        Value::Number(number) => number.is_finite(),
        Value::Position(position) => position.to_array().iter().all(|number| number.is_finite()),
        Value::Word(_) | Value::Text(_) => true,
    };
    if is_finite { Ok(()) } else { Err(TextError::new(format!("not a finite number: {value}"))) }
}

fn effects(text: &str) -> Result<Vec<Effect>, String> {
    if text == "none" {
        return Ok(Vec::new());
    }
    split(text, ';').into_iter().map(effect).collect()
}

/// The lists of effects before, between and after each `...`.
fn effects_with_gaps(text: &str) -> Result<Vec<Vec<Effect>>, String> {
    let parts = split(text, ';');
    let lists = parts.split(|part| *part == "...");
    if !parts.contains(&"...") {
        return Ok(vec![effects(text)?]);
    }
    lists.map(|parts| parts.iter().map(|part| effect(part)).collect()).collect()
}

fn effect(text: &str) -> Result<Effect, String> {
    let (name, rest) = text.split_once(' ').unwrap_or((text, ""));
    Arguments::parse(rest)
        .and_then(|arguments| Effect::read(name, arguments))
        .and_then(|effect| {
            effect.arguments().iter().try_for_each(|(_, value)| check_finite(value))?;
            Ok(effect)
        })
        .map_err(|error| format!("effect `{text}`: {}", error.message))
}

/// Whether an end is no fault and not one of ours.
pub fn is_accepted(end: &End) -> bool {
    matches!(
        end,
        End::ProgramEnd
            | End::PercentEnd
            | End::StreamEnd
            | End::Endless
            | End::Paused
            | End::Aborted
    )
}

#[cfg(test)]
mod tests {
    use gaugeblock_vocabulary::Position;

    use super::*;

    #[test]
    fn reads_each_form() {
        for text in [
            "accepted",
            "refused",
            "refused at 2",
            "refused at cave.ngc:3@2",
            "kind nothing_saved",
            "ends program_end",
            "after 3@1 units = inch, position = (x1 y2), spindle[0] = clockwise",
            "at end plane = xy, #31 = 5, #<_a> = 2",
            "at straight_feed@2 feed_rate = 100",
            "effects at 4: straight_feed end=(x1 y2); dwell seconds=2",
            "effects at 4: ...; straight_feed end=(x1 y2); ...; dwell seconds=2",
            "effects: none",
            "unchanged at 4",
            "unchanged at cave.ngc:4@2 but feed_rate, spindle[0], position, #31",
            "count straight_feed = 3",
            "messages: a=1 | b=2",
            "output: \"N10 X1\\n\"",
            "warnings: X has no value | AXIS(3) is not modal",
            "after 3 variable[AXIS(3)] = \"1.5\", set[X_CURPOS] = on, modal[AXIS] = no",
            "pin digital_out[0]: 1, 0",
            "pin analog_out[3]: -1.5",
            "pin coolant_mist: none",
            "when saved-state.motion-mode = restored: after 5 motion = feed",
            "when order.feed-unit = old and edition = linuxcnc-2.9: refused at 2",
        ] {
            assert!(text.parse::<Assertion>().is_ok(), "{text}: {:?}", text.parse::<Assertion>());
        }
        let effect = "effects: straight_feed end=()".parse::<Assertion>().expect("readable");
        assert_eq!(
            effect.claim,
            Claim::Effects(vec![Effect::StraightFeed { end: Position::default() }])
        );
    }

    #[test]
    fn joins_guards() {
        let text = "when order.feed-unit = old and edition = gpp2: accepted";
        let guards = text.parse::<Assertion>().expect("readable").guards;
        let pair = |id: &str, option: &str| (id.to_owned(), option.to_owned());
        assert_eq!(guards, [pair("order.feed-unit", "old"), pair("edition", "gpp2")]);
    }

    #[test]
    fn refuses_what_is_none() {
        for text in [
            "",
            "excepted",
            "after units = inch",
            "at end unit = mm",
            "ends well",
            "output: N10",
            "after 3 set[X] = yes",
            "after 3 feed_rate = NaN",
            "at end position = (x1 yinf)",
            "effects: dwell seconds=inf",
            "effects: ...; dwell seconds=1",
            "effects at 4: ...; none",
            "unchanged",
            "unchanged at x",
            "unchanged at 4 but feed",
            "pin analog_out[0]: 1, NaN",
            "kind odd",
            "pin digital_out[0]",
            "pin digital_out: 1",
            "pin digital_out[0]: on",
            "pin horn: 1",
            "pin coolant_mist: 1,",
            "when order.feed-unit: accepted",
            "when order.feed-unit = old and: accepted",
        ] {
            assert!(text.parse::<Assertion>().is_err(), "{text}");
        }
    }
}
