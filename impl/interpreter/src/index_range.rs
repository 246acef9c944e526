//! Adjacent members of a list.

/// From the first member up to the one before `to`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct IndexRange {
    pub(crate) from: usize,
    pub(crate) to: usize,
}

impl IndexRange {
    pub(crate) fn of<T>(self, row: &[T]) -> &[T] {
        row.get(self.from..self.to).unwrap_or_default()
    }
}
