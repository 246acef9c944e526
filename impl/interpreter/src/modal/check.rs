//! The checks of a block's words against each other: groups, numbers of words, words that nothing uses, words that
//! are missing.

use alloc::format;

use gaugeblock_vocabulary::{FaultKind, Motion};

use crate::faults::{PlantedFault, planted};
use crate::quirks;
use crate::words::Words;

use super::Modal;
use super::codes::{
    COMPENSATION, COOLANT, FREE, G_GROUPS, GCode, GGroup, IO, MGroup, MOTION, NON_MODAL, OVERRIDES,
    SINGLE_OVERRIDES, STOP_RANK, TOOL_LENGTH, g_code, m_code, set_data,
};
use super::letters::{AXES, F, H, I, J, K, S, T, X, Y, first_letter};
use super::motion_codes::{code_of, is_cycle};
use super::refusal::{Refusal, refuse};

/// Most M words of a block (11.4.9).
const M_WORDS_ALLOWED: usize = 4;
/// G80.
const CANCEL: u16 = 800;
/// No code of a group.
const NONE: u16 = u16::MAX;

/// A block whose words go together: its codes by modal group and by order of execution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block<'a> {
    /// All words.
    pub(crate) words: &'a Words,
    g: [u16; G_GROUPS],
    m: [(u8, u16); M_WORDS_ALLOWED],
    /// The move that the block makes or whose mode it sets, as `G` in tenths; none for suspended motion.
    pub(crate) motion: Option<u16>,
    /// Whether the axis words belong to the move.
    pub(crate) axes_move: bool,
}

/// The words that the codes of a block use and need together.
#[derive(Default)]
struct WordUse {
    uses: u32,
    needs: u32,
    needs_axes: bool,
    dollar: bool,
    axis_codes: u8,
}

impl WordUse {
    fn add(&mut self, code: &GCode) {
        self.uses |= code.uses;
        self.needs |= code.needs;
        self.needs_axes |= code.needs_axes;
        self.dollar |= code.dollar;
    }
}

impl<'a> Block<'a> {
    /// The code of a group, in tenths.
    pub(crate) fn g(&self, group: GGroup) -> Option<u16> {
        self.g.get(usize::from(group)).copied().filter(|code| *code != NONE)
    }

    /// The M codes with their ranks, in the order of execution.
    pub(crate) fn m(&self) -> impl Iterator<Item = (u8, u16)> + 'a {
        self.m.into_iter().filter(|(_, code)| *code != NONE)
    }
}

impl Modal {
    /// Checks the words of a block against each other.
    pub(super) fn check<'a>(&self, words: &'a Words) -> Result<Block<'a>, Refusal> {
        let mut block = Block {
            words,
            g: [NONE; G_GROUPS],
            m: [(u8::MAX, NONE); M_WORDS_ALLOWED],
            motion: None,
            axes_move: false,
        };
        let mut used = WordUse::default();
        self.add_g_codes(&mut block, &mut used)?;
        self.add_m_codes(&mut block, &mut used)?;
        let implied = self.implied_motion(&block, &used);
        if let Some(code) = implied.and_then(g_code) {
            used.add(&code);
        }
        if self.emulates_rs274 && block.m().any(|(_, code)| code == 19) {
            // Quirks rs274.orient-without-angle and rs274.orient-without-timeout.
            used.needs = 0;
        }
        if self.emulates_rs274 {
            let motion = block.g(MOTION).or(implied);
            used.uses |= quirks::ignored(words, block.g(COMPENSATION), motion);
        }
        if words.dollar.is_some() && self.choices.no_later_codes {
            return refuse(FaultKind::UnusedWord, "no code uses a $ word");
        }
        check_words(words, &used)?;
        check_polar(&block, &used)?;
        self.check_axes(&mut block, &used, implied)?;
        Ok(block)
    }

    /// Checks the words of a block that is read and not executed.
    pub(super) fn check_read(&self, words: &Words) -> Result<(), Refusal> {
        self.check(words).map(drop)
    }

    fn add_g_codes(&self, block: &mut Block<'_>, used: &mut WordUse) -> Result<(), Refusal> {
        for tenths in block.words.g_words() {
            let code = if *tenths == 100 {
                Some(set_data(block.words.get(b'L'), self.choices.set_needs_axes))
            } else {
                g_code(*tenths)
            };
            let Some(code) = code else {
                return refuse(
                    FaultKind::UnknownCode,
                    format!("G{} is not a known code", code_text(*tenths)),
                );
            };
            match block.g.get_mut(usize::from(code.group)) {
                Some(slot) if *slot == NONE || planted(PlantedFault::LastWins) => *slot = *tenths,
                // Quirk rs274.cancel-with-motion.
                Some(slot) if code.group == MOTION && self.emulates_rs274 && *slot == CANCEL => {
                    *slot = *tenths;
                }
                Some(_) if self.emulates_rs274 && *tenths == CANCEL => continue,
                Some(_) | None => {
                    let text = code_text(*tenths);
                    return refuse(
                        FaultKind::ModalConflict,
                        format!(
                            "G{text} and another code of its group: only one of them per block"
                        ),
                    );
                }
            }
            used.add(&code);
            if code.uses_axes() && code.group != MOTION {
                used.axis_codes = used.axis_codes.saturating_add(1);
            }
        }
        let both =
            block.g(NON_MODAL) == Some(520) && block.g(MOTION).is_some_and(|code| code != 800);
        if both && planted(PlantedFault::LocalOffsetMoves) {
            used.axis_codes = used.axis_codes.saturating_sub(1);
        }
        Ok(())
    }

    fn add_m_codes(&self, block: &mut Block<'_>, used: &mut WordUse) -> Result<(), Refusal> {
        let codes = block.words.m_words();
        let fewer = usize::from(planted(PlantedFault::FourthMWord));
        if codes.len() > M_WORDS_ALLOWED.saturating_sub(fewer) {
            return refuse(FaultKind::TooManyMCodes, "more than four M words in a block");
        }
        let mut groups = FREE;
        for (slot, number) in block.m.iter_mut().zip(codes) {
            let is_later = matches!(number, 19 | 98 | 99) && self.choices.no_later_codes;
            let Some(code) = m_code(*number).filter(|_| !is_later) else {
                return refuse(FaultKind::UnknownCode, format!("M{number} is not a known code"));
            };
            let group = self.group_of(*number, code.group);
            if groups & group != 0 && !planted(PlantedFault::MCodesTogether) {
                return refuse(
                    FaultKind::ModalConflict,
                    format!("M{number} and another code of its group: only one of them per block"),
                );
            }
            groups |= group;
            used.uses |= code.uses;
            used.needs |= code.needs;
            used.dollar |= code.dollar;
            *slot = (rank_of(*number, code.rank), *number);
        }
        if codes.len() > 1 {
            block.m.sort_unstable();
        }
        Ok(())
    }

    /// Whether M98 and M99 are in the language.
    pub(crate) fn has_numbered_programs(&self) -> bool {
        !self.choices.no_later_codes
    }

    /// The groups that a code excludes, as the options have them.
    fn group_of(&self, number: u16, group: MGroup) -> MGroup {
        match group {
            IO if self.choices.independent_io => FREE,
            SINGLE_OVERRIDES if self.choices.one_override_group => OVERRIDES,
            SINGLE_OVERRIDES => FREE,
            COOLANT if self.choices.both_coolants => match number {
                7 => 1 << 12,
                8 => 1 << 13,
                _ => 1 << 12 | 1 << 13,
            },
            _ => group,
        }
    }

    /// Assigns the axis words to a code that uses them itself, or to the move (11.4.13).
    fn check_axes(
        &self,
        block: &mut Block<'_>,
        used: &WordUse,
        implied: Option<u16>,
    ) -> Result<(), Refusal> {
        let words = block.words;
        let explicit = block.g(MOTION);
        let machine_coordinates = block.g(NON_MODAL) == Some(530);
        let arc = matches!(explicit, Some(20 | 30));
        if words.axes() == 0 {
            // A code that uses axis words does so also where there are none, except for G43.2 with H (11.4.13,
            // 11.5.30).
            let by_length = u8::from(matches!(block.g(TOOL_LENGTH), Some(431 | 432)));
            let moves = !matches!(explicit, None | Some(800 | 53));
            if moves && used.axis_codes > by_length {
                return refuse(FaultKind::AxisWords, "two codes that use axis words");
            }
            let needs_axes = used.needs_axes
                && !(machine_coordinates && planted(PlantedFault::MachineWithoutAxes))
                && !self.repeats_in_place(explicit);
            if needs_axes || machine_coordinates && !planted(PlantedFault::MachineWithoutAxes) {
                return refuse(FaultKind::MissingWord, "an axis word is missing");
            }
            block.motion = explicit.or(implied);
            // A full circle has no axis words.
            block.axes_move = arc || implied.is_some();
            return self.check_length_alone(block);
        }
        let foreign = words.axes() & !self.axes;
        if foreign != 0 {
            let letter = first_letter(foreign);
            return refuse(FaultKind::NoSuchAxis, format!("the machine has no axis {letter}"));
        }
        self.check_length_alone(block)?;
        match (used.axis_codes, explicit) {
            (0, _) => {
                block.motion = explicit.or(implied);
                block.axes_move = true;
                if matches!(block.motion, None | Some(800 | 53)) {
                    return refuse(
                        FaultKind::AxisWords,
                        "axis words without a code that uses them",
                    );
                }
            }
            (1, None | Some(800 | 53))
                if block.g(NON_MODAL) == Some(100) && self.refuses_axes_of_reload(words) =>
            {
                return refuse(FaultKind::UnusedWord, "G10 L0 with axis words");
            }
            (_, None | Some(800 | 53)) if self.is_cancelled_for_offsets(explicit) => {
                return refuse(FaultKind::AxisWords, "axis words while G80 is in force");
            }
            // G43.1 and a code of group 0 may both use them: only a code of group 1 together with one of those is an
            // error (11.4.13, 11.5.29).
            (_, None | Some(800 | 53)) => block.motion = explicit,
            _ => return refuse(FaultKind::AxisWords, "axis words that two codes use"),
        }
        Ok(())
    }

    /// Whether no motion mode is in force, and codes that use axis words of their own are refused for that.
    fn is_cancelled_for_offsets(&self, explicit: Option<u16>) -> bool {
        self.choices.no_axis_words_after_cancel
            && (explicit == Some(800) || (explicit.is_none() && self.motion == Motion::None))
    }

    /// Whether the block has the code of the cycle in force, and that needs no axis word: a planted fault.
    fn repeats_in_place(&self, code: Option<u16>) -> bool {
        planted(PlantedFault::AgainWithoutAxes)
            && is_cycle(self.motion)
            && code == Some(code_of(self.motion))
    }

    /// G43.1, G43.2 and G49: their own rules on words (11.5.29, 11.5.30); G53 needs a straight move.
    fn check_length_alone(&self, block: &Block<'_>) -> Result<(), Refusal> {
        let words = block.words;
        let machine_coordinates = block.g(NON_MODAL) == Some(530);
        match block.g(TOOL_LENGTH) {
            // G53 is a motion, by whichever code (11.5.33).
            Some(431 | 432)
                if machine_coordinates && words.has_axes() && block.g(MOTION).is_none() =>
            {
                return refuse(FaultKind::AxisWords, "G53 in the block of a tool length offset");
            }
            Some(431) if !matches!(block.g(MOTION), None | Some(800)) => {
                return refuse(FaultKind::AxisWords, "motion in the block of G43.1");
            }
            Some(432) if words.present & H != 0 && words.has_axes() => {
                return refuse(FaultKind::AxisWords, "G43.2 with H and with axis words");
            }
            Some(432) if words.present & (H | AXES) == 0 => {
                return refuse(FaultKind::MissingWord, "G43.2 without H and without axis words");
            }
            Some(490) if self.choices.length_off_without_motion && has_axis_code(block) => {
                return refuse(FaultKind::AxisWords, "G49 in the block of a code with axis words");
            }
            Some(_) | None => {}
        }
        let straight = match block.g(MOTION) {
            Some(code) => matches!(code, 0 | 10),
            None => matches!(self.motion, Motion::Traverse | Motion::Feed),
        };
        if machine_coordinates && !straight {
            return refuse(FaultKind::AxisWords, "G53 without G0 or G1");
        }
        Ok(())
    }

    /// The motion mode as a code in tenths, where a later block repeats it.
    pub(super) fn motion_code(&self) -> Option<u16> {
        if self.motion == Motion::None && planted(PlantedFault::AfterCancel) {
            return Some(0);
        }
        Some(code_of(self.motion)).filter(|code| *code != 800)
    }

    /// The code of the move that axis words alone make again.
    pub(super) fn repeated_motion(&self) -> Result<u16, Refusal> {
        let Some(code) = self.motion_code() else {
            return refuse(FaultKind::AxisWords, "axis words, and no motion mode is left");
        };
        Ok(code)
    }

    /// The move that is made again because there are axis words and no code that uses them (11.4.11).
    fn implied_motion(&self, block: &Block<'_>, used: &WordUse) -> Option<u16> {
        let words = block.words;
        let offsets_alone = self.choices.arc_offsets_alone
            && matches!(self.motion, Motion::ArcClockwise | Motion::ArcCounterclockwise)
            && words.present & (I | J | K) & !used.uses != 0;
        let moves = words.axes() != 0 || offsets_alone;
        let again = block.g(MOTION).is_none() && used.axis_codes == 0 && moves;
        if again { self.motion_code() } else { None }
    }
}

/// The place of an M code in the order of execution, which planted faults change.
fn rank_of(number: u16, rank: u8) -> u8 {
    if planted(PlantedFault::ByNumber) && rank < STOP_RANK {
        return 0;
    }
    if matches!(number, 70 | 73) && planted(PlantedFault::SaveAfterCoolant) { 55 } else { rank }
}

/// Whether a block has a code besides G49 that Grbl counts among those that use axis words.
fn has_axis_code(block: &Block<'_>) -> bool {
    matches!(block.g(MOTION), Some(0 | 10 | 20 | 30 | 382..=385))
        || matches!(block.g(NON_MODAL), Some(100 | 280 | 300 | 920))
}

/// Words that nothing uses, and words that are missing. F, S and T are codes of their own.
fn check_words(words: &Words, used: &WordUse) -> Result<(), Refusal> {
    let unused = words.present & !(used.uses | AXES | F | S | T);
    if unused != 0 && !planted(PlantedFault::UnusedWord) {
        let letter = first_letter(unused);
        return refuse(FaultKind::UnusedWord, format!("nothing uses the {letter} word"));
    }
    if words.dollar.is_some() && !used.dollar && words.present & S == 0 {
        return refuse(FaultKind::UnusedWord, "nothing uses the $ word");
    }
    let missing = used.needs & !words.present;
    if missing != 0 {
        let letter = first_letter(missing);
        return refuse(FaultKind::MissingWord, format!("the {letter} word is missing"));
    }
    Ok(())
}

/// Polar words replace X and Y of a move (11.4.12): a block does not have both, and an offset is not a move.
fn check_polar(block: &Block<'_>, used: &WordUse) -> Result<(), Refusal> {
    let words = block.words;
    if !words.is_polar() {
        return Ok(());
    }
    if words.present & (X | Y) != 0 {
        return refuse(FaultKind::AxisWords, "polar words together with X or Y");
    }
    if used.axis_codes != 0 && !matches!(block.g(NON_MODAL), Some(280 | 300)) {
        return refuse(FaultKind::UnusedWord, "polar words of a code that is not a move");
    }
    Ok(())
}

/// `59.1` for 591.
fn code_text(tenths: u16) -> alloc::string::String {
    let (whole, tenth) = (tenths.checked_div(10).unwrap_or(0), tenths.checked_rem(10).unwrap_or(0));
    if tenth == 0 { format!("{whole}") } else { format!("{whole}.{tenth}") }
}
