//! Formats: how a number is printed, and what it is when it is read back.
//!
//! A format has no modality of its own in GPP2. In the old GPP it has one, which is that of the variables declared
//! with it.

use std::cmp::Ordering;

use crate::ids::choice::gpp::Tie;

/// The names of the formats. The first is that of texts.
pub const NAMES: [&str; 19] = [
    "CHARACTER",
    "COORDINATES",
    "ANGLES",
    "FEED",
    "SPINDLE",
    "DWELL",
    "SEQUENCING",
    "TOOL",
    "USER_1",
    "USER_2",
    "USER_3",
    "USER_4",
    "USER_5",
    "USER_6",
    "USER_7",
    "USER_8",
    "USER_9",
    "USER_10",
    "REAL",
];

/// The place of the format of texts.
pub const CHARACTER: usize = 0;
/// The place of the format in which expressions are compared.
pub const REAL: usize = NAMES.len() - 1;
/// Most digits on either side of the point.
pub const MOST_DIGITS: usize = 14;

/// How numbers are printed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Format {
    /// Fewest and most digits before the point.
    pub integer: (usize, usize),
    /// Fewest and most digits after it.
    pub fraction: (usize, usize),
    /// Missing digits before the point are zeros, not blanks.
    pub leading: bool,
    /// Missing digits after the point are zeros, not blanks.
    pub trailing: bool,
    /// Before a number that is not below zero.
    pub plus: Option<char>,
    /// Before a number below zero.
    pub minus: Option<char>,
    /// Between the digits.
    pub point: char,
    /// The point stands after a whole number too.
    pub whole_point: bool,
    /// What is printed for zero, where that is not its digits.
    pub zero: Option<String>,
    /// The modality of its variables in the old GPP.
    pub modal: bool,
}

/// A number with more digits before the point than its format has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLong;

/// The formats that hold until the toolpath gives others.
pub fn all() -> Vec<Format> {
    let digits = |name: &str| match name {
        "FEED" => ((1, 5), (0, 1)),
        "SPINDLE" | "SEQUENCING" | "TOOL" => ((1, 5), (0, 0)),
        "DWELL" => ((1, 5), (0, 2)),
        "REAL" => ((1, MOST_DIGITS), (1, MOST_DIGITS)),
        _ => ((1, 5), (0, 3)),
    };
    let format = |name: &&str| Format {
        integer: digits(name).0,
        fraction: digits(name).1,
        leading: true,
        trailing: true,
        plus: None,
        minus: Some('-'),
        point: '.',
        whole_point: false,
        zero: None,
        modal: **name == *NAMES[CHARACTER],
    };
    NAMES.iter().map(format).collect()
}

/// A number as a format sees it: rounded, in decimal digits.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Rounded {
    is_negative: bool,
    /// Digits before the point, without leading zeros.
    whole: String,
    /// Digits after the point, without trailing zeros.
    fraction: String,
}

impl Rounded {
    fn is_zero(&self) -> bool {
        self.whole.is_empty() && self.fraction.is_empty()
    }
}

impl Format {
    /// Rule gpp.number-format. A number is rounded to the most digits of a fraction, and has so many digits, zeros,
    /// blanks and signs as its format says.
    ///
    /// # Errors
    /// It has too many digits before the point.
    pub fn text(&self, value: f64, tie: Tie) -> Result<String, TooLong> {
        let rounded = self.rounded(value, tie)?;
        if let (true, Some(zero)) = (rounded.is_zero(), &self.zero) {
            return Ok(zero.clone());
        }
        let fill = |digit: bool, have: usize, fewest: usize| {
            let filler = if digit { "0" } else { " " };
            filler.repeat(fewest.saturating_sub(have))
        };
        let before = fill(self.leading, rounded.whole.len(), self.integer.0);
        let after = fill(self.trailing, rounded.fraction.len(), self.fraction.0);
        let has_fraction = !(rounded.fraction.is_empty() && after.is_empty());
        let sign = if rounded.is_negative { self.minus } else { self.plus };
        let point = (has_fraction || self.whole_point).then_some(self.point);
        let mut text: String = sign.into_iter().collect();
        text.push_str(&before);
        text.push_str(&rounded.whole);
        text.extend(point);
        text.push_str(&rounded.fraction);
        text.push_str(&after);
        Ok(text)
    }

    /// The number that is printed, whatever zero, signs and the point look like.
    ///
    /// # Errors
    /// It has too many digits before the point.
    pub(super) fn read_back(&self, value: f64, tie: Tie) -> Result<f64, TooLong> {
        let rounded = self.rounded(value, tie)?;
        let sign = if rounded.is_negative { "-" } else { "" };
        let text = format!("{sign}0{}.{}0", rounded.whole, rounded.fraction);
        Ok(text.parse().expect("formats: digits with a point are a number"))
    }

    fn rounded(&self, value: f64, tie: Tie) -> Result<Rounded, TooLong> {
        let (whole, fraction) = rounded_digits(value.abs(), self.fraction.1, tie);
        let (whole, fraction) = (whole.trim_start_matches('0'), fraction.trim_end_matches('0'));
        if whole.len() > self.integer.1 {
            return Err(TooLong);
        }
        let is_zero = whole.is_empty() && fraction.is_empty();
        Ok(Rounded {
            is_negative: value < 0.0 && !is_zero,
            whole: whole.to_owned(),
            fraction: fraction.to_owned(),
        })
    }
}

/// The digits of a number that is not negative, before and after the point.
///
/// Sixty digits after the point tell every tie from what is none: a number in the middle between two of `most` (14 or
/// fewer) digits ends soon after, and no other binary number is closer to it than 1e-31.
fn rounded_digits(value: f64, most: usize, tie: Tie) -> (String, String) {
    let exact = format!("{value:.60}");
    let (whole, fraction) = exact.split_once('.').unwrap_or((&exact, ""));
    let (kept, rest) = fraction.split_at(most);
    let mut digits: Vec<u8> = whole.bytes().chain(kept.bytes()).collect();
    let is_odd = digits.last().is_some_and(|digit| (digit - b'0') % 2 == 1);
    let middle = format!("{:0<width$}", 5, width = rest.len());
    let up = match rest.cmp(middle.as_str()) {
        Ordering::Greater => true,
        Ordering::Equal => tie == Tie::Away || is_odd,
        Ordering::Less => false,
    };
    if up {
        count_up(&mut digits);
    }
    let fraction = digits.split_off(digits.len() - most);
    let text = |digits: Vec<u8>| digits.into_iter().map(char::from).collect();
    (text(digits), text(fraction))
}

/// The next number with as many digits, or one more.
fn count_up(digits: &mut Vec<u8>) {
    for digit in digits.iter_mut().rev() {
        if *digit < b'9' {
            *digit += 1;
            return;
        }
        *digit = b'0';
    }
    digits.insert(0, b'1');
}
