//! Names of HAL items.

/// The name of a HAL item, in lower case: a number, if it has one, between a prefix and a suffix. It is never put
/// together as a text.
///
/// ```
/// use gaugeblock_interpreter::ItemName;
/// assert!(ItemName::plain("motion.feed-hold").is("motion.feed-hold"));
/// let output = ItemName::numbered("motion.digital-out-", 7, 2, "");
/// assert!(output.is("motion.digital-out-07"));
/// assert!(!output.is("motion.digital-out-7") && !output.is("motion.digital-out-007"));
/// assert!(ItemName::numbered("spindle.", 12, 1, ".on").is("spindle.12.on"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ItemName {
    before: &'static str,
    /// The number and how many digits it has at least.
    number: Option<(u16, usize)>,
    behind: &'static str,
}

impl ItemName {
    /// A name without a number.
    pub fn plain(name: &'static str) -> Self {
        Self { before: name, number: None, behind: "" }
    }

    /// A name with a number of so many digits at least.
    pub fn numbered(
        before: &'static str,
        number: u16,
        digits: usize,
        behind: &'static str,
    ) -> Self {
        Self { before, number: Some((number, digits)), behind }
    }

    /// Whether this is how it is written.
    pub fn is(&self, name: &str) -> bool {
        let rest = name.strip_prefix(self.before);
        let rest = rest.and_then(|rest| rest.strip_suffix(self.behind));
        match (rest, self.number) {
            (Some(rest), None) => rest.is_empty(),
            (Some(rest), Some((number, digits))) => {
                let length = number.checked_ilog10().unwrap_or(0).saturating_add(1);
                let length = usize::try_from(length).map_or(digits, |length| length.max(digits));
                let plain = rest.bytes().all(|byte| byte.is_ascii_digit());
                plain && rest.len() == length && rest.parse() == Ok(number)
            }
            (None, _) => false,
        }
    }
}
