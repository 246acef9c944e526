//! The table of codes: the modal group of each code, and the words that it uses.

use super::groups::ModalGroup;
use super::groups::ModalGroup as Group;

/// A G or M code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Code {
    /// G codes in tenths (10 is G1, 382 is G38.2), M codes as they are.
    pub number: u32,
    /// Its modal group; M48 and M49 are a group, M50 to M53, M62 to M68 and M70 to M73 are in none.
    pub group: Option<ModalGroup>,
    /// The letters that it uses, axis words apart.
    pub words: &'static str,
    /// Whether it uses axis words.
    pub axis_words: bool,
}

/// A code of a modal group with the letters that it uses.
const fn code(number: u32, group: ModalGroup, words: &'static str) -> Code {
    Code { number, group: Some(group), words, axis_words: false }
}

/// A code of a modal group that uses axis words.
const fn axes(number: u32, group: ModalGroup, words: &'static str) -> Code {
    Code { number, group: Some(group), words, axis_words: true }
}

/// A code of no modal group.
const fn alone(number: u32, words: &'static str) -> Code {
    Code { number, group: None, words, axis_words: false }
}

/// The letters of an arc: offsets of its centre, its radius, its turns.
pub const ARC: &str = "ijkrp";

/// Every G code of the language.
pub const G_CODES: &[Code] = &[
    axes(0, Group::Motion, ""),
    axes(10, Group::Motion, ""),
    axes(20, Group::Motion, ARC),
    axes(30, Group::Motion, ARC),
    code(40, Group::NonModal, "p"),
    axes(50, Group::Motion, "ijpq"),
    axes(51, Group::Motion, "ij"),
    axes(52, Group::Motion, "pl"),
    axes(53, Group::Motion, ""),
    code(70, Group::Lathe, ""),
    code(80, Group::Lathe, ""),
    axes(100, Group::NonModal, "lpqrij"),
    code(170, Group::Plane, ""),
    code(171, Group::Plane, ""),
    code(180, Group::Plane, ""),
    code(181, Group::Plane, ""),
    code(190, Group::Plane, ""),
    code(191, Group::Plane, ""),
    code(200, Group::Units, ""),
    code(210, Group::Units, ""),
    axes(280, Group::NonModal, ""),
    code(281, Group::NonModal, ""),
    axes(300, Group::NonModal, ""),
    code(301, Group::NonModal, ""),
    axes(330, Group::Motion, "k$"),
    axes(331, Group::Motion, "ki$"),
    axes(382, Group::Motion, ""),
    axes(383, Group::Motion, ""),
    axes(384, Group::Motion, ""),
    axes(385, Group::Motion, ""),
    code(400, Group::Compensation, ""),
    code(410, Group::Compensation, "d"),
    code(411, Group::Compensation, "dl"),
    code(420, Group::Compensation, "d"),
    code(421, Group::Compensation, "dl"),
    code(430, Group::ToolLength, "h"),
    axes(431, Group::ToolLength, ""),
    axes(432, Group::ToolLength, "h"),
    code(490, Group::ToolLength, ""),
    axes(520, Group::NonModal, ""),
    code(530, Group::NonModal, ""),
    code(540, Group::WorkOffset, ""),
    code(550, Group::WorkOffset, ""),
    code(560, Group::WorkOffset, ""),
    code(570, Group::WorkOffset, ""),
    code(580, Group::WorkOffset, ""),
    code(590, Group::WorkOffset, ""),
    code(591, Group::WorkOffset, ""),
    code(592, Group::WorkOffset, ""),
    code(593, Group::WorkOffset, ""),
    code(610, Group::Path, ""),
    code(611, Group::Path, ""),
    code(640, Group::Path, "pq"),
    axes(700, Group::Motion, "qdep"),
    axes(710, Group::Motion, "qdir"),
    axes(711, Group::Motion, "qdir"),
    axes(712, Group::Motion, "qdir"),
    axes(720, Group::Motion, "qdir"),
    axes(721, Group::Motion, "qdir"),
    axes(722, Group::Motion, "qdir"),
    axes(730, Group::Motion, "rql"),
    axes(740, Group::Motion, "rlp$"),
    axes(760, Group::Motion, "pzijrkqhel$"),
    code(800, Group::Motion, ""),
    axes(810, Group::Motion, "rl"),
    axes(820, Group::Motion, "rlp"),
    axes(830, Group::Motion, "rlq"),
    axes(840, Group::Motion, "rlp$"),
    axes(850, Group::Motion, "rl"),
    axes(860, Group::Motion, "rlp$"),
    axes(870, Group::Motion, "rlpijk"),
    axes(880, Group::Motion, "rlp"),
    axes(890, Group::Motion, "rlp"),
    code(900, Group::Distance, ""),
    code(901, Group::ArcDistance, ""),
    code(910, Group::Distance, ""),
    code(911, Group::ArcDistance, ""),
    axes(920, Group::NonModal, ""),
    code(921, Group::NonModal, ""),
    code(922, Group::NonModal, ""),
    code(923, Group::NonModal, ""),
    code(930, Group::FeedMode, ""),
    code(940, Group::FeedMode, ""),
    code(950, Group::FeedMode, "$"),
    code(960, Group::SpindleMode, "d$"),
    code(970, Group::SpindleMode, "$"),
    code(980, Group::Retract, ""),
    code(990, Group::Retract, ""),
];

/// Every M code of the language below M100.
pub const M_CODES: &[Code] = &[
    code(0, Group::Stopping, ""),
    code(1, Group::Stopping, ""),
    code(2, Group::Stopping, ""),
    code(3, Group::Spindle, "$"),
    code(4, Group::Spindle, "$"),
    code(5, Group::Spindle, "$"),
    code(6, Group::ToolChange, ""),
    code(7, Group::Coolant, ""),
    code(8, Group::Coolant, ""),
    code(9, Group::Coolant, ""),
    code(19, Group::Spindle, "rpq$"),
    code(30, Group::Stopping, ""),
    code(48, Group::Overrides, "$"),
    code(49, Group::Overrides, "$"),
    alone(50, "p"),
    alone(51, "p$"),
    alone(52, "p"),
    alone(53, "p"),
    code(60, Group::Stopping, ""),
    code(61, Group::ToolChange, "q"),
    alone(62, "p"),
    alone(63, "p"),
    alone(64, "p"),
    alone(65, "p"),
    alone(66, "pelq"),
    alone(67, "eq"),
    alone(68, "eq"),
    alone(70, ""),
    alone(71, ""),
    alone(72, ""),
    alone(73, ""),
    alone(98, "pl"),
    alone(99, ""),
];

/// M100 to M199.
const USER_DEFINED: Code = code(100, Group::UserDefined, "pq");

/// A G code, in tenths; none when the language does not have it.
pub fn g_code(number: u32) -> Option<&'static Code> {
    in_table(G_CODES, number)
}

/// An M code; none when the language does not have it.
pub fn m_code(number: u32) -> Option<&'static Code> {
    match number {
        100..=199 => Some(&USER_DEFINED),
        _ => in_table(M_CODES, number),
    }
}

/// A code of a table, which is in the order of numbers.
fn in_table(table: &'static [Code], number: u32) -> Option<&'static Code> {
    let place = table.binary_search_by_key(&number, |code| code.number).ok()?;
    table.get(place)
}

/// A G code as it is written: `G38.2`.
pub fn g_text(number: u32) -> String {
    match number % 10 {
        0 => format!("G{}", number / 10),
        tenth => format!("G{}.{tenth}", number / 10),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_listed_once_and_in_order() {
        for table in [G_CODES, M_CODES] {
            assert!(table.windows(2).all(|pair| pair[0].number < pair[1].number));
        }
    }

    #[test]
    fn codes_are_written_as_people_write_them() {
        assert_eq!(g_text(10), "G1");
        assert_eq!(g_text(382), "G38.2");
    }
}
