//! Mutated blocks: slips of a person, or of a bad post-processor.

use super::entropy::Entropy;
use super::malformed;

/// Characters that are inserted.
const SLIPS: &[char] =
    &['x', 'g', '1', '.', '-', '[', ']', '#', '=', '(', 'm', ' ', 'o', '$', '<', '%', 'z', '0'];

/// Words that are appended and often do not belong to a block.
const WORDS: &[&str] = &[
    " p1", " q2", " l3", " x1", " g1", " g0", " m5", " m70", " f100", " s0", " h1", " d1", " r1",
    " i1", " k2", " e1", " t1", " $1", " p-1", " f-1", " f0", " s-5", " g54", " g92 x1", " g4 p1",
    " m62 p1", " #31=1", " n5", " m3.5", " g1.5",
];

/// The block with one mutation, or a malformed block instead.
pub(super) fn mutated_block(line: &str, entropy: &mut Entropy<'_>) -> String {
    let chars: Vec<char> = line.chars().collect();
    let count = u32::try_from(chars.len()).unwrap_or(u32::MAX);
    let place = usize::try_from(entropy.below(count)).unwrap_or_default();
    match entropy.below(8) {
        0 if count > 1 => without(&chars, place),
        1 => {
            let slip = *entropy.pick(SLIPS);
            let mut text: String = chars.iter().take(place).collect();
            text.push(slip);
            text.extend(chars.iter().skip(place));
            text
        }
        2 => {
            let words: Vec<&str> = line.split_whitespace().collect();
            if words.is_empty() {
                line.to_owned()
            } else {
                format!("{line} {}", entropy.pick(&words))
            }
        }
        3 | 4 => format!("{line}{}", entropy.pick(WORDS)),
        5 if count > 1 => {
            let mut swapped = chars.clone();
            swapped.swap(place, (place + 1) % chars.len());
            swapped.into_iter().collect()
        }
        6 => {
            let other = *entropy.pick(&[
                "-1", "1.5", "99999", "0.00001", "1e3", "#<none>", "[1/0]", "[", "sqrt[-1]",
            ]);
            match line.rfind(|c: char| c.is_ascii_digit()) {
                Some(at) => format!("{}{other}", &line[..at]),
                None => format!("{line}{other}"),
            }
        }
        _ => malformed::block(entropy),
    }
}

fn without(chars: &[char], place: usize) -> String {
    chars.iter().enumerate().filter(|(at, _)| *at != place).map(|(_, c)| *c).collect()
}
