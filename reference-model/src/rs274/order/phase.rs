//! The phases of a block and which of them a block has.

use crate::rs274::evaluate::Words;
use crate::rs274::modes::{ModalGroup, g_code, m_code};

/// What becomes of a block after one of its phases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AfterPhase {
    /// The later phases are executed.
    Execute,
    /// There are none, and the program pauses: M0, M1, M60.
    Pause,
    /// There are none, and the program has ended: M2, M30.
    ProgramEnd,
}

/// A phase of a block. The order of the list is the order of execution.
///
/// The document's list leaves out the spindle mode, the lathe mode and the arc distance mode. The spindle mode goes
/// with its S word, the lathe mode with the length unit, since both say how long a word is, and the arc distance mode
/// with the distance mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Phase {
    /// The comment, when it is active.
    Comment,
    /// G93, G94, G95.
    FeedMode,
    /// F.
    FeedRate,
    /// S, and G96, G97.
    SpindleSpeed,
    /// T.
    SelectTool,
    /// M62 to M68.
    InputsOutputs,
    /// M6, M61.
    ChangeTool,
    /// M3, M4, M5, M19.
    Spindle,
    /// M70, M71, M72, M73.
    SavedState,
    /// M7, M8, M9.
    Coolant,
    /// M48 to M53.
    Overrides,
    /// M100 to M199.
    UserCode,
    /// G4.
    Dwell,
    /// G17 to G19.1.
    Plane,
    /// G20, G21, G7, G8.
    Units,
    /// G40 to G42.1.
    Compensation,
    /// G43 to G49.
    ToolLength,
    /// G54 to G59.3.
    WorkOffset,
    /// G61, G61.1, G64.
    Path,
    /// G90, G91, G90.1, G91.1.
    Distance,
    /// G98, G99.
    Retract,
    /// G10, G28, G30, G52, G92.
    OffsetData,
    /// G0, G1, G80, and axis words alone.
    Motion,
    /// M0, M1, M2, M30, M60.
    Stop,
}

impl Phase {
    /// Every phase, in the order of execution.
    pub const ALL: &'static [Self] = &[
        Self::Comment,
        Self::FeedMode,
        Self::FeedRate,
        Self::SpindleSpeed,
        Self::SelectTool,
        Self::InputsOutputs,
        Self::ChangeTool,
        Self::Spindle,
        Self::SavedState,
        Self::Coolant,
        Self::Overrides,
        Self::UserCode,
        Self::Dwell,
        Self::Plane,
        Self::Units,
        Self::Compensation,
        Self::ToolLength,
        Self::WorkOffset,
        Self::Path,
        Self::Distance,
        Self::Retract,
        Self::OffsetData,
        Self::Motion,
        Self::Stop,
    ];

    /// The phase of a G code.
    fn of_g(number: u32) -> Option<Self> {
        match number {
            40 => Some(Self::Dwell),
            530 => Some(Self::Motion),
            _ if OFFSET_DATA.contains(&number) => Some(Self::OffsetData),
            _ => g_code(number)?.group.and_then(Self::of_group),
        }
    }

    /// The phase of an M code.
    fn of_m(number: u32) -> Option<Self> {
        match number {
            48..=53 => Some(Self::Overrides),
            62..=68 => Some(Self::InputsOutputs),
            70..=73 => Some(Self::SavedState),
            100..=199 => Some(Self::UserCode),
            _ => m_code(number)?.group.and_then(Self::of_group),
        }
    }

    /// The phase of the codes of a modal group, where it is one for all of them.
    fn of_group(group: ModalGroup) -> Option<Self> {
        match group {
            ModalGroup::FeedMode => Some(Self::FeedMode),
            ModalGroup::SpindleMode => Some(Self::SpindleSpeed),
            ModalGroup::ToolChange => Some(Self::ChangeTool),
            ModalGroup::Spindle => Some(Self::Spindle),
            ModalGroup::Coolant => Some(Self::Coolant),
            ModalGroup::Plane => Some(Self::Plane),
            ModalGroup::Units | ModalGroup::Lathe => Some(Self::Units),
            ModalGroup::Compensation => Some(Self::Compensation),
            ModalGroup::ToolLength => Some(Self::ToolLength),
            ModalGroup::WorkOffset => Some(Self::WorkOffset),
            ModalGroup::Path => Some(Self::Path),
            ModalGroup::Distance | ModalGroup::ArcDistance => Some(Self::Distance),
            ModalGroup::Retract => Some(Self::Retract),
            ModalGroup::Motion => Some(Self::Motion),
            ModalGroup::Stopping => Some(Self::Stop),
            ModalGroup::NonModal
            | ModalGroup::InputsOutputs
            | ModalGroup::Overrides
            | ModalGroup::UserDefined => None,
        }
    }

    /// The phase of a word that is not a code.
    fn of_letter(letter: char) -> Option<Self> {
        match letter {
            'f' => Some(Self::FeedRate),
            's' => Some(Self::SpindleSpeed),
            't' => Some(Self::SelectTool),
            _ => None,
        }
    }
}

/// Some phases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Phases(u32);

impl Phases {
    /// These.
    pub const fn these(phases: &[Phase]) -> Self {
        let mut bits = 0;
        let mut place = 0;
        while place < phases.len() {
            bits |= 1 << phases[place] as u32;
            place += 1;
        }
        Self(bits)
    }

    /// Those in which a block has something to do.
    pub fn of(words: &Words) -> Self {
        let by_g = words.g_tenths.iter().filter_map(|number| Phase::of_g(*number));
        let by_m = words.m.iter().filter_map(|number| Phase::of_m(*number));
        let by_letters = words.letters.keys().filter_map(|letter| Phase::of_letter(*letter));
        let comment = words.comment.is_some().then_some(Phase::Comment);
        let moves = moves_without_code(words).then_some(Phase::Motion);
        let phases = by_g.chain(by_m).chain(by_letters).chain(comment).chain(moves);
        Self(phases.fold(0, |bits, phase| bits | (1 << phase as u32)))
    }

    /// Whether a phase is among them.
    #[inline]
    pub fn contains(self, phase: Phase) -> bool {
        self.meets(Self::these(&[phase]))
    }

    /// Whether one of them is among others.
    #[inline]
    pub fn meets(self, others: Self) -> bool {
        self.0 & others.0 != 0
    }

    /// How many there are.
    pub fn count(self) -> u32 {
        self.0.count_ones()
    }

    /// All of them, in the order of execution.
    pub fn iter(self) -> impl Iterator<Item = Phase> {
        let mut left = self.0;
        std::iter::from_fn(move || {
            let first = Phase::ALL.get(left.trailing_zeros() as usize)?;
            left ^= 1 << *first as u32;
            Some(*first)
        })
    }
}

/// G codes that change the data of offsets, or go to a stored position.
const OFFSET_DATA: [u32; 10] = [100, 280, 281, 300, 301, 520, 920, 921, 922, 923];

/// Whether axis words, polar ones too, or offsets of a centre stand in the block for no code that uses them: then the
/// motion mode does.
///
/// Rule modal-groups.motion-suspended. A code of group 0 that uses axis words suspends the motion mode for its block.
pub fn moves_without_code(words: &Words) -> bool {
    let codes = || words.g_tenths.iter().filter_map(|number| g_code(*number));
    let offset = |letter: &&char| matches!(**letter, 'i'..='k');
    let offsets = words.letters.keys().find(offset);
    let uses_offsets = |offset: &char| codes().any(|code| code.words.contains(*offset));
    let by_offsets = offsets.is_some_and(|offset| !uses_offsets(offset));
    moves_by_axis_words(words) || by_offsets && !codes().any(|code| code.axis_words)
}

/// Whether the block has axis words or polar words that no code uses.
pub fn moves_by_axis_words(words: &Words) -> bool {
    let used =
        words.g_tenths.iter().filter_map(|number| g_code(*number)).any(|code| code.axis_words);
    has_axis_words(words) && !used
}

/// Whether a letter is one of an axis, or of the polar words in place of X and Y.
pub fn is_of_axis(letter: char) -> bool {
    matches!(letter, 'x' | 'y' | 'z' | 'a' | 'b' | 'c' | 'u' | 'v' | 'w' | '@' | '^')
}

/// Whether a block has axis words.
pub fn has_axis_words(words: &Words) -> bool {
    words.letters.keys().any(|letter| is_of_axis(*letter))
}
