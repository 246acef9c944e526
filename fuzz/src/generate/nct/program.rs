//! Programs: the first one is run, and calls the others.

use super::statements::{Place, Writer};
use super::values::spelled;
use crate::generate::Entropy;

/// The text of all programs.
pub(super) fn programs(entropy: &mut Entropy<'_>) -> String {
    let count = entropy.range(1, 5);
    let mut blocks = Vec::new();
    let is_named = entropy.chance(90);
    for number in 1..=count {
        if number > 1 || is_named {
            let form = if entropy.chance(30) { "%\nO000" } else { "O" };
            blocks.push(format!("{form}{number}"));
        }
        let called: Vec<u32> =
            if entropy.chance(3) { (1..=count).collect() } else { (number + 1..=count).collect() };
        let place = if number == 1 { Place::Main } else { Place::Called };
        let mut writer = Writer::new(entropy, place, &called);
        writer.body();
        blocks.append(&mut writer.blocks);
    }
    let spelled = blocks.iter().map(|block| spelled(block, entropy) + "\n");
    spelled.collect()
}
