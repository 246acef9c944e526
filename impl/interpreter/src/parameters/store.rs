//! All parameters, and the values of the interpreter that predefined parameters report.

use alloc::vec::Vec;

use super::named::{Internal, Named};
use super::numbered::Numbered;

/// The version of the manual, as `_vmajor` reports it.
const VERSION: f64 = 2.9;

/// All parameters.
#[derive(Clone, Debug)]
pub(crate) struct Parameters {
    /// `#1` and so on.
    pub(crate) numbered: Numbered,
    /// `#<name>`.
    pub(crate) named: Named,
    /// `_line`.
    pub(crate) line: u32,
    /// `_call_level`.
    pub(crate) call_level: u32,
    /// `_task`: whether the interpreter controls a machine.
    pub(crate) controls_machine: bool,
    /// `_value`.
    pub(crate) value: f64,
    /// `_value_returned`.
    pub(crate) value_returned: bool,
    /// `_hal[…]`: the values of HAL items that the caller set last.
    pub(crate) items: Vec<f64>,
}

impl Parameters {
    /// The value of a predefined parameter of the interpreter.
    pub(crate) fn internal(&self, name: Internal) -> f64 {
        match name {
            Internal::Line => f64::from(self.line),
            Internal::Value => self.value,
            Internal::ValueReturned => f64::from(u8::from(self.value_returned)),
            Internal::CallLevel => f64::from(self.call_level),
            Internal::Task => f64::from(u8::from(self.controls_machine)),
            Internal::RemapLevel | Internal::VersionMinor => 0.0,
            Internal::VersionMajor => VERSION,
            Internal::Item(place) => self.item(place),
        }
    }

    /// The value of a HAL item, by its index among the declared items.
    fn item(&self, place: u32) -> f64 {
        let item = usize::try_from(place).ok().and_then(|place| self.items.get(place));
        item.copied().unwrap_or(0.0)
    }

    /// Sets the values of HAL items.
    pub(crate) fn set_items(&mut self, values: &[f64]) {
        for (item, value) in self.items.iter_mut().zip(values) {
            *item = *value;
        }
    }
}
