//! The table of codes: modal group, words that a code uses and needs, what it does with axis words.

use crate::faults::{PlantedFault, narrowed, planted};
use crate::math;

use super::letters::{ARC_WORDS, AXES, D, E, H, I, J, K, L, P, Q, R, S};

/// A modal group of G codes: its number in table 11.7 of the 2.9 manual.
pub(crate) type GGroup = u8;

pub(crate) const NON_MODAL: GGroup = 0;
pub(crate) const MOTION: GGroup = 1;
pub(crate) const PLANE: GGroup = 2;
pub(crate) const DISTANCE: GGroup = 3;
pub(crate) const ARC_DISTANCE: GGroup = 4;
pub(crate) const FEED_MODE: GGroup = 5;
pub(crate) const UNITS: GGroup = 6;
pub(crate) const COMPENSATION: GGroup = 7;
pub(crate) const TOOL_LENGTH: GGroup = 8;
pub(crate) const RETRACT: GGroup = 10;
pub(crate) const WORK_OFFSET: GGroup = 12;
pub(crate) const PATH: GGroup = 13;
pub(crate) const SPINDLE_MODE: GGroup = 14;
pub(crate) const LATHE: GGroup = 15;
/// How many places a list by group has.
pub(crate) const G_GROUPS: usize = 16;

/// A G code and the words that it takes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GCode {
    /// Modal group.
    pub(crate) group: GGroup,
    /// Letters that it can use; axis letters among them where it uses axis words itself.
    pub(crate) uses: u32,
    /// Letters that it cannot do without.
    pub(crate) needs: u32,
    /// Whether at least one axis word is needed.
    pub(crate) needs_axes: bool,
    /// Whether `$` says something to it.
    pub(crate) dollar: bool,
}

impl GCode {
    const fn plain(group: GGroup) -> Self {
        Self { group, uses: 0, needs: 0, needs_axes: false, dollar: false }
    }

    const fn using(self, uses: u32) -> Self {
        Self { uses: self.uses | uses, ..self }
    }

    const fn needing(self, needs: u32) -> Self {
        Self { uses: self.uses | needs, needs: self.needs | needs, ..self }
    }

    const fn needing_axes(self) -> Self {
        Self { uses: self.uses | AXES, needs_axes: true, ..self }
    }

    const fn with_spindle(self) -> Self {
        Self { dollar: true, ..self }
    }

    /// Accepted, and then undefined: no word of its block is wrong.
    const fn undefined(group: GGroup) -> Self {
        Self { uses: u32::MAX, dollar: true, ..Self::plain(group) }
    }

    /// A canned cycle: axis words, R and L (11.5.43.1, 11.5.43.3).
    const fn cycle() -> Self {
        Self::plain(MOTION).needing_axes().using(R | L)
    }

    /// Whether the code uses axis words of its own.
    pub(crate) const fn uses_axes(&self) -> bool {
        self.uses & AXES != 0
    }
}

/// The G code of a number in tenths (`G59.1` is 591), if the documents have it.
pub(crate) const fn g_code(tenths: u16) -> Option<GCode> {
    Some(match tenths {
        40 => GCode::plain(NON_MODAL).needing(P),
        // Its L says more: `set_data`.
        100 => GCode::plain(NON_MODAL).needing(L).using(P | R | I | J | Q | AXES),
        280 | 300 => GCode::plain(NON_MODAL).using(AXES),
        520 | 920 => GCode::plain(NON_MODAL).needing_axes(),
        // Its axis words are those of the move that it modifies.
        281 | 301 | 530 | 921 | 922 | 923 => GCode::plain(NON_MODAL),
        0 | 10 => GCode::plain(MOTION).using(AXES),
        800 | 53 => GCode::plain(MOTION),
        20 | 30 => GCode::plain(MOTION).using(AXES | ARC_WORDS),
        50 => GCode::plain(MOTION).needing_axes().needing(P | Q).using(I | J),
        51 => GCode::plain(MOTION).needing_axes().using(I | J),
        52 => GCode::plain(MOTION).using(AXES | P | L),
        330 => GCode::plain(MOTION).needing_axes().needing(K).with_spindle(),
        331 => GCode::plain(MOTION).needing_axes().needing(K).using(I).with_spindle(),
        382..=385 => GCode::plain(MOTION).needing_axes(),
        700 => GCode::plain(MOTION).needing(Q).using(AXES | D | E | P),
        710..=712 | 720..=722 => GCode::plain(MOTION).needing(Q).using(AXES | D | I | R),
        760 => {
            let required = GCode::plain(MOTION).needing_axes().needing(P | I | J | K);
            required.using(R | Q | H | E | L).with_spindle()
        }
        810 | 850 => GCode::cycle(),
        730 | 830 => GCode::cycle().using(Q),
        820 | 890 => GCode::cycle().using(P),
        740 | 840 | 860 => GCode::cycle().using(P).with_spindle(),
        870 | 880 => GCode::undefined(MOTION),
        170 | 171 | 180 | 181 | 190 | 191 => GCode::plain(PLANE),
        900 | 910 => GCode::plain(DISTANCE),
        901 | 911 => GCode::plain(ARC_DISTANCE),
        930 | 940 => GCode::plain(FEED_MODE),
        950 => GCode::plain(FEED_MODE).with_spindle(),
        200 | 210 => GCode::plain(UNITS),
        400 => GCode::plain(COMPENSATION),
        410 | 420 => GCode::plain(COMPENSATION).using(D),
        411 | 421 => GCode::plain(COMPENSATION).needing(D).using(L),
        430 => GCode::plain(TOOL_LENGTH).using(H),
        431 => GCode::plain(TOOL_LENGTH).needing_axes(),
        // Either H or axis words: 11.5.30.
        432 => GCode::plain(TOOL_LENGTH).using(H | AXES),
        490 => GCode::plain(TOOL_LENGTH),
        980 | 990 => GCode::plain(RETRACT),
        540 | 550 | 560 | 570 | 580 | 590..=593 => GCode::plain(WORK_OFFSET),
        610 | 611 => GCode::plain(PATH),
        640 => GCode::plain(PATH).using(P | Q),
        960 => GCode::plain(SPINDLE_MODE).needing(S).using(D).with_spindle(),
        970 => GCode::plain(SPINDLE_MODE).with_spindle(),
        70 | 80 => GCode::plain(LATHE),
        _ => return None,
    })
}

/// G10: L selects the table that it changes (11.5.12 to 11.5.17). Whether L2 needs an axis word is a choice.
pub(crate) fn set_data(l: Option<f64>, set_needs_axes: bool) -> GCode {
    let plain = GCode::plain(NON_MODAL).needing(L).using(AXES);
    let l = l.map(|l| narrowed(PlantedFault::OffsetKindWraps, l, 256.0));
    match l.and_then(math::near_integer) {
        Some(0) => plain,
        Some(1 | 10 | 11) => plain.needing(P).using(R | I | J | Q),
        Some(2) if planted(PlantedFault::SetWithoutSystem) => plain.using(P | R),
        Some(2) if set_needs_axes => plain.needing(P).using(R).needing_axes(),
        Some(2) => plain.needing(P).using(R),
        Some(20) => plain.needing(P).needing_axes(),
        _ => plain.using(P | R | I | J | Q),
    }
}

/// A modal group of M codes, as a bit: table 11.8, with the groups that the sections name besides.
pub(crate) type MGroup = u16;

/// In no group.
pub(crate) const FREE: MGroup = 0;
/// Group 4.
pub(crate) const STOPPING: MGroup = 1 << 4;
/// Group 5; whether it excludes is an option.
pub(crate) const IO: MGroup = 1 << 5;
/// Group 6.
pub(crate) const TOOL_CHANGE: MGroup = 1 << 6;
/// Group 7.
pub(crate) const SPINDLE: MGroup = 1 << 7;
/// Group 8; whether M7 and M8 exclude each other is an option.
pub(crate) const COOLANT: MGroup = 1 << 8;
/// Group 9, M48 and M49; whether M50 to M53 belong to it is an option.
pub(crate) const OVERRIDES: MGroup = 1 << 9;
/// M50 to M53.
pub(crate) const SINGLE_OVERRIDES: MGroup = 1 << 11;
/// Group 10.
pub(crate) const USER_DEFINED: MGroup = 1 << 10;

/// An M code and the words that it takes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MCode {
    /// Modal group.
    pub(crate) group: MGroup,
    /// Place in the order of execution (11.4.23), smallest first.
    pub(crate) rank: u8,
    /// Letters that it can use.
    pub(crate) uses: u32,
    /// Letters that it cannot do without.
    pub(crate) needs: u32,
    /// Whether `$` says something to it.
    pub(crate) dollar: bool,
}

/// Codes of this rank and above come after the motion.
pub(crate) const STOP_RANK: u8 = 90;

const fn m(group: MGroup, rank: u8) -> MCode {
    MCode { group, rank, uses: 0, needs: 0, dollar: false }
}

impl MCode {
    const fn using(self, uses: u32) -> Self {
        Self { uses: self.uses | uses, ..self }
    }

    const fn needing(self, needs: u32) -> Self {
        Self { uses: self.uses | needs, needs: self.needs | needs, ..self }
    }

    const fn with_spindle(self) -> Self {
        Self { dollar: true, ..self }
    }
}

/// The M code of a number, if the documents have it. M98 and M99 do not come here.
pub(crate) const fn m_code(number: u16) -> Option<MCode> {
    Some(match number {
        62..=65 => m(IO, 10).needing(P),
        66 => m(IO, 11).using(P | E | L | Q),
        67 | 68 => m(IO, 12).needing(E | Q),
        6 => m(TOOL_CHANGE, 20),
        61 => m(TOOL_CHANGE, 21).needing(Q),
        3..=5 => m(SPINDLE, 30).with_spindle(),
        19 => m(SPINDLE, 30).needing(R | Q).using(P).with_spindle(),
        70 => m(FREE, 40),
        73 => m(FREE, 41),
        72 => m(FREE, 42),
        71 => m(FREE, 43),
        7 | 8 => m(COOLANT, 51),
        9 => m(COOLANT, 50),
        48 | 49 => m(OVERRIDES, 60).with_spindle(),
        50 => m(SINGLE_OVERRIDES, 61).using(P),
        51 => m(SINGLE_OVERRIDES, 62).using(P).with_spindle(),
        52 => m(SINGLE_OVERRIDES, 63).using(P),
        53 => m(SINGLE_OVERRIDES, 64).using(P),
        100..=199 => m(USER_DEFINED, 70).using(P | Q),
        0..=2 | 30 | 60 => m(STOPPING, STOP_RANK),
        _ => return None,
    })
}
