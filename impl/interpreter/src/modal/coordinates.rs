//! Nine coordinates and the arithmetic on them.

use gaugeblock_vocabulary::{Axis, LengthUnit, Position};

use crate::words::Words;

use super::letters::{A, AXES, B, C, U, V, W, X, Y, Z};

/// X Y Z A B C U V W.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Coordinates(pub(crate) [f64; 9]);

impl PartialEq for Coordinates {
    /// Field by field: whether arrays are compared in a loop the compiler decides anew with every change elsewhere.
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.position() == other.position()
    }
}

/// Converts lengths to another unit: a product and a quotient, so that 25.4 mm are exactly 1 inch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Conversion {
    times: f64,
    over: f64,
}

impl Conversion {
    /// From one unit to another.
    pub(crate) fn between(from: LengthUnit, to: LengthUnit) -> Self {
        match (from, to) {
            (LengthUnit::Inch, LengthUnit::Millimetre) => Self { times: 25.4, over: 1.0 },
            (LengthUnit::Millimetre, LengthUnit::Inch) => Self { times: 1.0, over: 25.4 },
            (LengthUnit::Inch, LengthUnit::Inch)
            | (LengthUnit::Millimetre, LengthUnit::Millimetre) => Self { times: 1.0, over: 1.0 },
        }
    }

    /// The same for lengths that are multiplied by a number besides.
    pub(crate) fn scaled(self, by: f64) -> Self {
        Self { times: self.times * by, ..self }
    }

    /// Back to the first unit.
    pub(crate) fn inverse(self) -> Self {
        Self { times: self.over, over: self.times }
    }

    /// The length in the other unit.
    pub(crate) fn of(self, length: f64) -> f64 {
        length * self.times / self.over
    }
}

impl Coordinates {
    /// Coordinate by coordinate.
    fn with(self, other: Self, combine: impl Fn(f64, f64) -> f64) -> Self {
        let mut result = self;
        for (mine, theirs) in result.0.iter_mut().zip(other.0) {
            *mine = combine(*mine, theirs);
        }
        result
    }

    /// The coordinate of an axis.
    pub(crate) fn coordinate_of(self, axis: Axis) -> f64 {
        self.0.get(axis.place()).copied().unwrap_or(0.0)
    }

    /// With another coordinate of one axis.
    pub(crate) fn with_axis(mut self, axis: Axis, coordinate: f64) -> Self {
        if let Some(place) = self.0.get_mut(axis.place()) {
            *place = coordinate;
        }
        self
    }

    /// The sum.
    pub(crate) fn plus(self, other: Self) -> Self {
        self.with(other, |mine, theirs| mine + theirs)
    }

    /// The difference.
    pub(crate) fn minus(self, other: Self) -> Self {
        self.with(other, |mine, theirs| mine - theirs)
    }

    /// Converts lengths to another unit; angles stay.
    pub(crate) fn converted(self, by: Conversion) -> Self {
        let [x, y, z, a, b, c, u, v, w] = self.0;
        Self([by.of(x), by.of(y), by.of(z), a, b, c, by.of(u), by.of(v), by.of(w)])
    }

    /// Turned about Z; sine and cosine of the angle.
    pub(crate) fn turned(self, (sine, cosine): (f64, f64)) -> Self {
        let [x, y, z, a, b, c, u, v, w] = self.0;
        Self([x * cosine - y * sine, x * sine + y * cosine, z, a, b, c, u, v, w])
    }

    /// With the coordinates of another point for the axes of some letters.
    pub(crate) fn taking(self, letters: u32, other: Self) -> Self {
        let mut result = self;
        let all = [X, Y, Z, A, B, C, U, V, W];
        for ((mine, theirs), letter) in result.0.iter_mut().zip(other.0).zip(all) {
            if letters & letter != 0 {
                *mine = theirs;
            }
        }
        result
    }

    /// With the axis words of a block in their places; the other coordinates stay.
    pub(crate) fn replaced(mut self, words: &Words) -> Self {
        self.replace(words);
        self
    }

    /// With the axis words of a block added.
    pub(crate) fn moved_by(mut self, words: &Words) -> Self {
        self.add(words);
        self
    }

    /// Puts the axis words of a block in their places.
    #[inline]
    pub(crate) fn replace(&mut self, words: &Words) {
        self.merge(words, |_, word| word);
    }

    /// Adds the axis words of a block.
    #[inline]
    pub(crate) fn add(&mut self, words: &Words) {
        self.merge(words, |old, word| old + word);
    }

    #[inline]
    fn merge(&mut self, words: &Words, merge: impl Fn(f64, f64) -> f64) {
        let present = words.present;
        let put = |letter: u32, coordinate: &mut f64, word: f64| {
            if present & letter != 0 {
                *coordinate = merge(*coordinate, word);
            }
        };
        let [word_a, word_b, word_c, .., word_u, word_v, word_w, word_x, word_y, word_z] =
            &words.values;
        let [x, y, z, a, b, c, u, v, w] = &mut self.0;
        put(X, x, *word_x);
        put(Y, y, *word_y);
        put(Z, z, *word_z);
        if present & (AXES & !(X | Y | Z)) != 0 {
            put(A, a, *word_a);
            put(B, b, *word_b);
            put(C, c, *word_c);
            put(U, u, *word_u);
            put(V, v, *word_v);
            put(W, w, *word_w);
        }
    }

    /// As the vocabulary has it.
    pub(crate) fn position(self) -> Position {
        Position::from(self.0)
    }
}

impl From<Position> for Coordinates {
    fn from(position: Position) -> Self {
        Self(position.to_array())
    }
}
