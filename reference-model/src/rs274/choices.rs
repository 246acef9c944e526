//! How the documents are read: the option of each choice, and each quirk, that this model knows.
//!
//! The sentences, sources and the programs that tell options apart are pages of the suite (`suite/choices`,
//! `suite/quirks`); a test of the suite holds [`CHOICES`] and [`QUIRKS`] and those pages against each other.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use gaugeblock_vocabulary::Options;

use crate::by_name::ByName;

/// Every choice that the model reads, with its options; the first is the default.
pub const CHOICES: &[(&str, &[&str])] = &[
    ("abort.read-ahead", &["none", "read-on"]),
    ("abort.spindle-and-coolant", &["switched-off", "left-alone"]),
    ("active-comments.absent-name", &["number-sign", "six-number-signs"]),
    ("active-comments.default-format", &["six-decimals", "four-decimals"]),
    ("active-comments.file-name-blanks", &["left-out", "part-of-it"]),
    ("active-comments.msg-without-comma", &["plain", "message"]),
    ("active-comments.plain-f-format", &["four-decimals", "six-decimals"]),
    ("active-comments.same-block-setting", &["new", "old"]),
    ("arcs.diameter-centre", &["radius", "diameter"]),
    ("arcs.offsets-alone", &["unused", "arc"]),
    ("arcs.radius-just-too-small", &["refused", "half-circle"]),
    ("arcs.small-tolerance", &["coarse", "fine"]),
    ("arcs.turns-below-one", &["refused", "one"]),
    ("arcs.zero-radius", &["refused", "accepted"]),
    ("control.comment-after-o-word", &["ignored", "refused"]),
    ("control.do-label", &["each", "refused", "first"]),
    ("control.ended-label", &["refused", "followed"]),
    (
        "control.repeat-fraction",
        &["rounded", "rounded-to-even", "rounded-down", "rounded-up", "refused"],
    ),
    ("control.repeat-negative", &["none", "refused"]),
    ("control.skipped-definition", &["counts", "does-not-count"]),
    ("control.sub-number-as-label", &["refused", "accepted"]),
    ("coolant.both-in-one-block", &["refused", "accepted"]),
    ("cycles.chip-break-return", &["retract", "return-level"]),
    ("cycles.sticky-arguments", &["sticky", "each-block"]),
    ("cycles.tap-direction", &["any", "as-cut"]),
    ("cycles.tap-return", &["reversed", "as-before"]),
    ("cycles.tap-without-dwell", &["refused", "zero"]),
    ("expressions.arctangent-range", &["half-turns", "full-turn"]),
    ("expressions.modulus-sign", &["not-negative", "dividend"]),
    ("expressions.negative-zero", &["none", "kept"]),
    ("expressions.order-tolerance", &["exact", "tolerant"]),
    ("expressions.round-half", &["away", "up", "even"]),
    ("expressions.true-value", &["one", "minus-one"]),
    ("expressions.unary-minus", &["accepted", "refused"]),
    ("fanuc-subs.call-itself", &["refused", "allowed"]),
    ("fanuc-subs.named-locals", &["hidden", "shared"]),
    ("fanuc-subs.value-after-call", &["cleared", "kept"]),
    ("fanuc-subs.zero-count-unknown", &["refused", "accepted"]),
    ("inputs.under-compensation", &["accepted", "refused"]),
    ("inputs.without-timeout", &["refused", "accepted"]),
    ("modal-groups.initial-motion", &["none", "feed", "traverse"]),
    ("modal-groups.initial-retract", &["r-plane", "old-z"]),
    ("modal-groups.io-members", &["exclusive", "independent"]),
    ("modal-groups.override-members", &["listed", "all"]),
    ("motion.without-axis-words", &["nothing", "move-in-place"]),
    ("offsets.change-under-compensation", &["accepted", "refused"]),
    ("orient.brake-otherwise", &["while-standing", "while-locked"]),
    ("orient.without-dollar", &["first", "all"]),
    ("orient.zero-timeout", &["refused", "accepted"]),
    ("outputs.at-once-over-waiting", &["kept", "replaces"]),
    ("outputs.under-compensation", &["accepted", "refused"]),
    ("outputs.waiting-after-abort", &["forgotten", "kept"]),
    ("outputs.waiting-after-end", &["kept", "forgotten"]),
    ("overrides.selected-feed", &["switched", "untouched"]),
    ("overrides.under-compensation", &["accepted", "refused"]),
    ("overrides.without-dollar", &["all", "first"]),
    ("parameters.absent-global", &["refused", "zero"]),
    ("parameters.function-number", &["refused", "accepted"]),
    ("parameters.lathe-flags", &["any-machine", "lathe-only"]),
    ("parameters.override-names", &["by-name", "as-written"]),
    ("parameters.read-only-numbered", &["refused", "written"]),
    ("parameters.retract-names", &["by-name", "as-written"]),
    ("parameters.setting-time", &["after-words", "before-words"]),
    ("parameters.spindle-on-at-zero", &["commanded", "turning"]),
    ("path-control.negative-tolerance", &["refused", "left-out"]),
    ("pause.cycle-start", &["refused", "goes-on"]),
    ("pause.during-dwell", &["goes-on", "stands-still"]),
    ("pause.pallet-codes", &["sections", "table"]),
    ("positions.rotated-axes", &["machine", "program"]),
    ("probe.standing-spindle", &["accepted", "refused"]),
    ("program-end.feed-after-mode-change", &["zero", "kept"]),
    ("program-end.spindles", &["all", "first"]),
    ("saved-state.after-run", &["kept", "forgotten"]),
    ("saved-state.invalidate-nothing", &["accepted", "refused"]),
    ("saved-state.listed-motion", &["listed", "every"]),
    ("saved-state.motion-mode", &["not-restored", "restored"]),
    ("saved-state.places", &["apart", "one"]),
    ("saved-state.restorable", &["either", "m70-only"]),
    ("spindle.minus-one", &["refused", "all"]),
    ("spindle.rpm-mode-speed", &["optional", "required"]),
    ("spindle.without-dollar", &["all", "first"]),
    ("splines.nurbs-feed", &["at-closing", "at-opening"]),
    ("subroutines.return-label", &["any", "own"]),
    ("task.mdi-in-manual", &["refused", "executed"]),
    ("text.comment-nested", &["refused", "plain"]),
    ("text.line-end-counted", &["counted", "not-counted"]),
    ("text.percent-alone", &["refused", "ends", "ignored"]),
    ("text.percent-unclosed-ended", &["accepted", "refused"]),
    ("threading.cycle-spindle", &["any", "turning"]),
    ("threading.slide-end", &["fixed", "with-depth"]),
    ("threading.without-degression", &["constant-depth", "constant-area"]),
    ("tool.change-under-compensation", &["accepted", "refused"]),
    ("tool.change-without-selection", &["refused", "accepted"]),
    ("tool.empty-slot", &["accepted", "refused"]),
    ("tool.entry-without-words", &["accepted", "refused"]),
    ("tool.length-under-compensation", &["accepted", "refused"]),
    ("tool.old-tool-place", &["its-own-slot", "slot-of-the-new"]),
    ("tool.selected-by", &["number", "slot"]),
    ("tool.set-number-in-program", &["accepted", "refused"]),
    ("tool.set-number-unknown", &["refused", "accepted"]),
    ("units-planes.diameter-offsets", &["moves-only", "every-word"]),
    ("units-planes.feed-over-unit-change", &["rescaled", "kept"]),
    ("units-planes.initial-unit", &["millimetre", "machine"]),
    ("units-planes.plane-under-compensation", &["accepted", "refused"]),
    ("user-codes.exit-status", &["ends-the-run", "ignored"]),
    ("user-codes.missing-argument", &["minus-one", "empty"]),
    ("user-codes.place", &["search-path", "program-prefix"]),
];

/// Every quirk that the model can show.
pub const QUIRKS: &[&str] = &[
    "linuxcnc.auto-after-program-end",
    "linuxcnc.auto-while-running",
    "linuxcnc.cycle-start-while-paused",
    "linuxcnc.initial-tolerance",
    "linuxcnc.input-number",
    "linuxcnc.modes-of-last-motion",
    "linuxcnc.orient-while-locked",
    "linuxcnc.output-number-at-once",
    "linuxcnc.output-number-with-motion",
    "linuxcnc.returned-value-kept",
    "linuxcnc.speed-releases-brake",
    "linuxcnc.wait-mode-times-out",
    "rs274.absolute-negative-zero",
    "rs274.additional-length-axes",
    "rs274.any-endsub",
    "rs274.arc-least-radius",
    "rs274.arc-no-radius",
    "rs274.arc-radius-tolerance",
    "rs274.blend-q-without-p",
    "rs274.break-remembered",
    "rs274.calculate-without-axes",
    "rs274.cancel-beside-offset",
    "rs274.cancel-with-motion",
    "rs274.chosen-spindle",
    "rs274.comment-before-o-word",
    "rs274.compensation-l-word",
    "rs274.continue-remembered",
    "rs274.continue-seeks-end",
    "rs274.cubic-without-direction",
    "rs274.cycle-dollar",
    "rs274.cycle-exact-path",
    "rs274.cycle-negative-dwell",
    "rs274.cycle-retract-from-initial",
    "rs274.cycle-rise",
    "rs274.dynamic-compensation-code",
    "rs274.dynamic-compensation-r-word",
    "rs274.dynamic-compensation-restore",
    "rs274.dynamic-length-with-motion",
    "rs274.dynamic-length-without-axes",
    "rs274.empty-name",
    "rs274.ends-in-other-subs",
    "rs274.exists-numbered",
    "rs274.fanuc-changes-at-end",
    "rs274.fanuc-count-too-large",
    "rs274.fanuc-zero-loops",
    "rs274.feed-lost-at-same-mode",
    "rs274.feed-mode-feed",
    "rs274.feed-name-inverse-time",
    "rs274.feed-name-number",
    "rs274.feed-speed-rounded",
    "rs274.feed-unit",
    "rs274.feed-zero-at-end",
    "rs274.file-with-two-subs",
    "rs274.first-spindle-saved",
    "rs274.g-code-tolerance",
    "rs274.g92-codes-apart",
    "rs274.hal-assignment",
    "rs274.inverse-time-zero-rate",
    "rs274.io-number-rounded",
    "rs274.last-parameter",
    "rs274.later-conditions-evaluated",
    "rs274.left-tap-repeat",
    "rs274.local-offset-restore",
    "rs274.log-closed",
    "rs274.lone-return",
    "rs274.long-format",
    "rs274.machine-incremental",
    "rs274.machine-rotary-offset",
    "rs274.machine-under-zero-radius",
    "rs274.machine-without-axes",
    "rs274.machine-zero-sign",
    "rs274.message-blanks",
    "rs274.message-parameter-zero",
    "rs274.message-small-value",
    "rs274.named-exists-early",
    "rs274.negative-dwell",
    "rs274.nine-levels",
    "rs274.number-in-sub",
    "rs274.numbers-of-all-files",
    "rs274.nurbs-machine-coordinates",
    "rs274.nurbs-order-two",
    "rs274.nurbs-weight",
    "rs274.off-not-restored",
    "rs274.offset-data-words",
    "rs274.orientation-too-large",
    "rs274.oriented-as-stopped",
    "rs274.orient-forgets-turning",
    "rs274.orient-without-angle",
    "rs274.orient-without-timeout",
    "rs274.origin-number-cut",
    "rs274.output-value-optional",
    "rs274.override-any-p",
    "rs274.override-dollar",
    "rs274.override-restore",
    "rs274.percent-in-file",
    "rs274.plane-restore",
    "rs274.polar-arc-plane",
    "rs274.polar-needs-angle",
    "rs274.polar-plane",
    "rs274.polar-repeated",
    "rs274.polar-to-origin",
    "rs274.position-move-in-place",
    "rs274.position-omitted-axes",
    "rs274.path-under-compensation",
    "rs274.per-revolution-dollar",
    "rs274.per-revolution-standing",
    "rs274.position-under-compensation",
    "rs274.probe-inverse-time",
    "rs274.probe-per-revolution",
    "rs274.probe-same-point",
    "rs274.quadratic-needs-both",
    "rs274.quadratic-of-zero",
    "rs274.repeat-counter-shared",
    "rs274.repeated-negative-word",
    "rs274.repeated-signs",
    "rs274.rest-of-restore-block",
    "rs274.retract-under-compensation",
    "rs274.return-after-call",
    "rs274.rotation-under-local-offset",
    "rs274.rounded-zero-sign",
    "rs274.rpm-mode-dollar",
    "rs274.same-system-kept",
    "rs274.save-in-spindle-group",
    "rs274.selected-tool-zero",
    "rs274.semicolon-plain",
    "rs274.shared-p",
    "rs274.shorter-lines",
    "rs274.skipped-is-read",
    "rs274.skipped-labels",
    "rs274.speed-of-all-spindles",
    "rs274.speed-override-at-end",
    "rs274.speed-override-dollar",
    "rs274.spindle-mode-at-end",
    "rs274.spindle-number-cut",
    "rs274.spline-not-modal",
    "rs274.spline-per-revolution",
    "rs274.stored-rotation",
    "rs274.sub-found-later",
    "rs274.sub-reached-again",
    "rs274.surface-limit-zero",
    "rs274.surface-speed-restore",
    "rs274.surface-speed-while-stopped",
    "rs274.synchronised-e-word",
    "rs274.synchronised-feed-word",
    "rs274.system-restore",
    "rs274.tap-axes",
    "rs274.tap-dwell-kept",
    "rs274.thread-any-plane",
    "rs274.thread-clearance",
    "rs274.thread-feed-override",
    "rs274.thread-long-taper",
    "rs274.thread-low-degression",
    "rs274.thread-negative-springs",
    "rs274.thread-other-axes",
    "rs274.tolerance-unit",
    "rs274.tool-offset-restore",
    "rs274.tool-offset-unit",
    "rs274.tool-entry-under-compensation",
    "rs274.tool-number-rounded",
    "rs274.unpassed-arguments-zero",
    "rs274.unused-q-minus-one",
    "rs274.value-at-definition",
    "rs274.value-cleared-at-return",
    "rs274.wait-mode-any",
    "rs274.wrong-format-sign",
    "rs274.zero-tool-offset-off",
];

/// What the model knows under an id.
#[derive(Clone, Copy, Debug)]
enum Known {
    /// A choice: its place in [`CHOICES`], its options.
    Choice(usize, &'static [&'static str]),
    /// A quirk: its id.
    Quirk(&'static str),
}

/// Slots of all choices and quirks.
const SLOTS: usize = 1 << 12;

/// Every choice and every quirk.
static REGISTER: LazyLock<ByName<Known>> = LazyLock::new(|| {
    let choices = (0..).zip(CHOICES);
    let choices = choices.map(|(place, (id, options))| (*id, Known::Choice(place, options)));
    let quirks = QUIRKS.iter().map(|id| (*id, Known::Quirk(id)));
    ByName::new(SLOTS, choices.chain(quirks).collect())
});

/// What the model knows under an id, if anything.
#[inline]
fn known(id: &str) -> Option<Known> {
    REGISTER.get(id).copied()
}

/// The options in force for a run.
#[derive(Clone, Debug)]
pub struct Choices {
    /// The option of each choice, in the order of [`CHOICES`].
    chosen: Vec<&'static str>,
    /// The quirks that are shown.
    shown: BTreeSet<&'static str>,
}

impl Default for Choices {
    /// The first option of each choice, and no quirk.
    fn default() -> Self {
        let chosen = CHOICES.iter().map(|(_, options)| options[0]).collect();
        Self { chosen, shown: BTreeSet::new() }
    }
}

impl Choices {
    /// Takes over a scenario's options; what it does not list has its default.
    ///
    /// # Errors
    /// An id or option that the model does not know, as a sentence.
    pub fn new(options: &Options) -> Result<Self, String> {
        let mut choices = Self::default();
        for (id, option) in &options.0 {
            match (known(id), option.as_str()) {
                (None, _) => return Err(format!("there is no choice or quirk {id}")),
                (Some(Known::Choice(place, options)), option) => {
                    let known = options.iter().find(|known| **known == option);
                    choices.chosen[place] = known.ok_or_else(|| {
                        format!("the choice {id} has the options {}", options.join(", "))
                    })?;
                }
                (Some(Known::Quirk(_)), "documented") => {}
                (Some(Known::Quirk(id)), "observed") => {
                    choices.shown.insert(id);
                }
                (Some(Known::Quirk(_)), _) => {
                    return Err(format!("the quirk {id} is documented or observed, not {option}"));
                }
            }
        }
        Ok(choices)
    }

    /// The option of a choice.
    ///
    /// # Panics
    /// The choice is not in [`CHOICES`]: a fault of the model.
    #[inline]
    pub fn choice(&self, id: &str) -> &'static str {
        let Some(Known::Choice(place, _)) = known(id) else {
            panic!("model: the choice {id} is not in the register")
        };
        self.chosen[place]
    }

    /// Whether a choice has this option.
    #[inline]
    pub fn is(&self, id: &str, option: &str) -> bool {
        debug_assert!(
            CHOICES.iter().any(|(choice, options)| *choice == id && options.contains(&option)),
            "model: {id} = {option} is not in the register"
        );
        self.choice(id) == option
    }

    /// Whether a quirk is shown.
    pub fn quirk(&self, id: &str) -> bool {
        debug_assert!(QUIRKS.contains(&id), "model: {id} is not in the register");
        self.shown.contains(id)
    }
}
