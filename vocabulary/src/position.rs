//! Nine coordinates.

use core::fmt;

#[cfg(feature = "serde")]
use crate::json::number::{read, write};
use crate::words::words;

words! {
    /// An axis of the machine.
    pub enum Axis {
        /// First linear axis.
        X = "x",
        /// Second linear axis.
        Y = "y",
        /// Third linear axis.
        Z = "z",
        /// Rotary axis about X.
        A = "a",
        /// Rotary axis about Y.
        B = "b",
        /// Rotary axis about Z.
        C = "c",
        /// Linear axis parallel to X.
        U = "u",
        /// Linear axis parallel to Y.
        V = "v",
        /// Linear axis parallel to Z.
        W = "w",
    }
}

impl Axis {
    /// The axis' place among the nine, from 0 for X to 8 for W.
    pub fn place(self) -> usize {
        self as usize
    }
}

/// Nine coordinates: X Y Z U V W in the length unit that the field names, A B C in degrees.
///
/// Written as `(x1 y2.5)`; an axis that is not written is at zero.
/// **Invariant:** this crate performs no arithmetic on positions.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields, default)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Position {
    /// X.
    #[cfg_attr(
        feature = "serde",
        serde(
            serialize_with = "write",
            deserialize_with = "read",
            skip_serializing_if = "is_zero"
        )
    )]
    pub x: f64,
    /// Y.
    #[cfg_attr(
        feature = "serde",
        serde(
            serialize_with = "write",
            deserialize_with = "read",
            skip_serializing_if = "is_zero"
        )
    )]
    pub y: f64,
    /// Z.
    #[cfg_attr(
        feature = "serde",
        serde(
            serialize_with = "write",
            deserialize_with = "read",
            skip_serializing_if = "is_zero"
        )
    )]
    pub z: f64,
    /// A, degrees.
    #[cfg_attr(
        feature = "serde",
        serde(
            serialize_with = "write",
            deserialize_with = "read",
            skip_serializing_if = "is_zero"
        )
    )]
    pub a: f64,
    /// B, degrees.
    #[cfg_attr(
        feature = "serde",
        serde(
            serialize_with = "write",
            deserialize_with = "read",
            skip_serializing_if = "is_zero"
        )
    )]
    pub b: f64,
    /// C, degrees.
    #[cfg_attr(
        feature = "serde",
        serde(
            serialize_with = "write",
            deserialize_with = "read",
            skip_serializing_if = "is_zero"
        )
    )]
    pub c: f64,
    /// U.
    #[cfg_attr(
        feature = "serde",
        serde(
            serialize_with = "write",
            deserialize_with = "read",
            skip_serializing_if = "is_zero"
        )
    )]
    pub u: f64,
    /// V.
    #[cfg_attr(
        feature = "serde",
        serde(
            serialize_with = "write",
            deserialize_with = "read",
            skip_serializing_if = "is_zero"
        )
    )]
    pub v: f64,
    /// W.
    #[cfg_attr(
        feature = "serde",
        serde(
            serialize_with = "write",
            deserialize_with = "read",
            skip_serializing_if = "is_zero"
        )
    )]
    pub w: f64,
}

#[cfg(feature = "serde")]
crate::json::number::own_form! {
    Position, |position| position.to_array().iter().all(|coordinate| coordinate.is_finite());
}

impl PartialEq for Position {
    /// All nine are looked at, without a branch for each: positions that are compared are most often the same.
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        let Self { x, y, z, a, b, c, u, v, w } = *other;
        let of_tool = (self.x == x) & (self.y == y) & (self.z == z);
        let of_table = (self.a == a) & (self.b == b) & (self.c == c);
        of_tool & of_table & (self.u == u) & (self.v == v) & (self.w == w)
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes the field by reference")]
fn is_zero(number: &f64) -> bool {
    number.to_bits() == 0
}

impl Position {
    /// The coordinate of an axis.
    pub fn get(&self, axis: Axis) -> f64 {
        self.to_array()[axis.place()]
    }

    /// The place of an axis' coordinate.
    pub fn get_mut(&mut self, axis: Axis) -> &mut f64 {
        match axis {
            Axis::X => &mut self.x,
            Axis::Y => &mut self.y,
            Axis::Z => &mut self.z,
            Axis::A => &mut self.a,
            Axis::B => &mut self.b,
            Axis::C => &mut self.c,
            Axis::U => &mut self.u,
            Axis::V => &mut self.v,
            Axis::W => &mut self.w,
        }
    }

    /// All nine, X to W.
    pub fn to_array(&self) -> [f64; 9] {
        [self.x, self.y, self.z, self.a, self.b, self.c, self.u, self.v, self.w]
    }
}

impl From<[f64; 9]> for Position {
    fn from([x, y, z, a, b, c, u, v, w]: [f64; 9]) -> Self {
        Self { x, y, z, a, b, c, u, v, w }
    }
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("(")?;
        let mut separator = "";
        for axis in Axis::ALL {
            let coordinate = self.get(*axis);
            if !is_zero(&coordinate) {
                write!(f, "{separator}{axis}{coordinate}")?;
                separator = " ";
            }
        }
        f.write_str(")")
    }
}
