//! Names become numbers, once, when a block is compiled.

use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

/// The number of a name in its table, counted from 0.
pub(crate) type NameId = u32;

/// An empty place in the table.
const EMPTY: u32 = u32::MAX;

/// A multiplier that spreads bits.
const MIX: u64 = 0x9e37_79b9_7f4a_7c15;

/// A table of names. It only grows; the caller bounds it.
///
/// The table is open-addressed and its order is never visible, so that a run depends on the text alone.
#[derive(Clone, Debug)]
pub(crate) struct Names {
    names: Vec<Box<str>>,
    /// Numbers by hash; its length is a power of two and at least twice the number of names.
    table: Vec<u32>,
    /// Short names by another hash, as numbers of their own, with their numbers in the table; 0 for an empty place.
    short: Vec<(u64, NameId)>,
    bytes: usize,
}

impl Names {
    /// An empty table.
    pub(crate) fn new() -> Self {
        Self { names: Vec::new(), table: vec![EMPTY; 64], short: vec![(0, EMPTY); 64], bytes: 0 }
    }

    /// How many names there are.
    pub(crate) fn len(&self) -> usize {
        self.names.len()
    }

    /// Bytes of all names.
    pub(crate) fn bytes(&self) -> usize {
        self.bytes
    }

    /// A name by its number; empty where there is none.
    pub(crate) fn name(&self, id: NameId) -> &str {
        usize::try_from(id).ok().and_then(|id| self.names.get(id)).map_or("", |name| name)
    }

    /// All names by number.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (NameId, &str)> {
        (0_u32..).zip(self.names.iter().map(|name| &**name))
    }

    /// The number of a name, a new one where the name is new.
    #[inline]
    pub(crate) fn intern(&mut self, name: &[u8]) -> NameId {
        let place = self.place(name);
        match self.table.get(place).copied() {
            Some(id) if id != EMPTY => return id,
            Some(_) | None => {}
        }
        self.add(name, place)
    }

    /// Fast path of [`Self::intern`]. The number of a known name at the beginning of a text, and its length with the
    /// bracket after it. None where the name is longer than seven characters, new, or not written as it is known.
    #[inline(always)]
    pub(crate) fn find_short(&self, text: &[u8]) -> Option<(NameId, usize)> {
        const ONES: u64 = 0x0101_0101_0101_0101;
        let word = u64::from_le_bytes(*text.first_chunk::<8>()?);
        let other = word ^ ONES.wrapping_mul(0x3e);
        let bracket = other.wrapping_sub(ONES) & !other & ONES.wrapping_mul(0x80);
        if bracket == 0 {
            return None;
        }
        let length = bracket.trailing_zeros() >> 3;
        let name = word & 1_u64.wrapping_shl(length << 3).wrapping_sub(1);
        let key = name | u64::from(length) << 56;
        let (found, id) = *self.short.get(self.short_place(key))?;
        let length = usize::try_from(length).unwrap_or(0).wrapping_add(1);
        (found == key && key != 0).then_some((id, length))
    }

    /// The place of a short name, or where it would be inserted.
    #[inline]
    fn short_place(&self, key: u64) -> usize {
        let mask = self.short.len().wrapping_sub(1);
        let mut place = usize::try_from(key.wrapping_mul(MIX) >> 40).unwrap_or(0) & mask;
        while let Some((found, _)) = self.short.get(place)
            && *found != 0
            && *found != key
        {
            place = place.wrapping_add(1) & mask;
        }
        place
    }

    /// Enters a name that is short into the table of short names.
    fn add_short(&mut self, id: NameId) {
        let Some(key) = short(self.name(id).as_bytes()) else { return };
        let place = self.short_place(key);
        if let Some(slot) = self.short.get_mut(place) {
            *slot = (key, id);
        }
    }

    /// A new name at its place. A name is text: what is none became so when it was read.
    #[cold]
    fn add(&mut self, name: &[u8], place: usize) -> NameId {
        let id = u32::try_from(self.names.len()).unwrap_or(EMPTY);
        self.names.push(String::from_utf8_lossy(name).into());
        self.bytes = self.bytes.saturating_add(name.len());
        if let Some(slot) = self.table.get_mut(place) {
            *slot = id;
        }
        if self.names.len().saturating_mul(2) > self.table.len() {
            self.grow();
        } else {
            self.add_short(id);
        }
        id
    }

    /// The place of a name in the table, or where it would be inserted.
    #[inline]
    fn place(&self, name: &[u8]) -> usize {
        let mask = self.table.len().wrapping_sub(1);
        let mut place = hash(name) & mask;
        loop {
            match self.table.get(place).copied() {
                Some(id) if id != EMPTY && self.name(id).as_bytes() != name => {
                    place = place.wrapping_add(1) & mask;
                }
                Some(_) | None => return place,
            }
        }
    }

    /// Doubles the table.
    fn grow(&mut self) {
        let longer = self.table.len().saturating_mul(2);
        self.table = vec![EMPTY; longer];
        self.short = vec![(0, EMPTY); longer];
        for at in 0..self.names.len() {
            let Some(name) = self.names.get(at) else { return };
            let place = self.place(name.as_bytes());
            if let Some(slot) = self.table.get_mut(place) {
                *slot = u32::try_from(at).unwrap_or(EMPTY);
            }
            self.add_short(u32::try_from(at).unwrap_or(EMPTY));
        }
    }
}

/// A name of one to seven characters as a number: its characters, and its length in the highest byte.
fn short(name: &[u8]) -> Option<u64> {
    let length = u8::try_from(name.len()).ok().filter(|length| (1..8).contains(length))?;
    let mut bytes = [0; 8];
    bytes.get_mut(..name.len())?.copy_from_slice(name);
    Some(u64::from_le_bytes(bytes) | u64::from(length) << 56)
}

/// FNV-1a, folded: names are short and chosen by the program's author.
fn hash(name: &[u8]) -> usize {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for byte in name {
        hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    }
    usize::try_from((hash ^ (hash >> 32)) & 0xffff_ffff).unwrap_or(0)
}
