//! Inputs over time: what they are, and when they do what a program waits for.

use gaugeblock_vocabulary::{Pin, WaitMode};

use super::EnvironmentState;

/// An input of the machine, by number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Input {
    /// A digital input.
    Digital(u32),
    /// An analog input.
    Analog(u32),
}

impl Input {
    fn name(self) -> String {
        match self {
            Self::Digital(number) => format!("digital_in[{number}]"),
            Self::Analog(number) => format!("analog_in[{number}]"),
        }
    }
}

/// How a wait will end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Awaited {
    /// What is awaited comes.
    Comes {
        /// After so many seconds.
        after: f64,
        /// The value that the input has then.
        value: f64,
    },
    /// It does not come in time.
    TimesOut {
        /// After so many seconds.
        after: f64,
    },
    /// It will never come, and nothing ends the wait.
    Never,
}

impl EnvironmentState {
    /// The value of an input now. One to which nothing is connected is zero.
    pub(crate) fn input(&self, input: Input) -> f64 {
        if self.is_stand_alone() {
            return 0.0;
        }
        self.wire(input).map_or_else(|| self.input_at(input, self.time), |pin| self.level(pin))
    }

    /// What comes of a wait for an input that begins now and lasts until the input does what is awaited, or for so
    /// many seconds.
    pub(crate) fn awaited(&self, input: Input, mode: WaitMode, timeout: Option<f64>) -> Awaited {
        let end = timeout.map(|seconds| self.time + seconds);
        match self.event(input, mode).filter(|event| end.is_none_or(|end| *event <= end)) {
            Some(event) => {
                let pin = self.wire(input);
                let value = pin.map_or_else(|| self.input_at(input, event), |pin| self.level(pin));
                Awaited::Comes { after: event - self.time, value }
            }
            None => timeout.map_or(Awaited::Never, |after| Awaited::TimesOut { after }),
        }
    }

    /// When an input does what is awaited, from now on.
    fn event(&self, input: Input, mode: WaitMode) -> Option<f64> {
        let is_high = |value: f64| value != 0.0;
        let mut before = is_high(self.input(input));
        let there = match mode {
            WaitMode::Immediate => true,
            WaitMode::High => before,
            WaitMode::Low => !before,
            WaitMode::Rise | WaitMode::Fall => false,
        };
        if there {
            return Some(self.time);
        }
        if self.wire(input).is_some() {
            // While a program waits it switches no output.
            return None;
        }
        let to_high = matches!(mode, WaitMode::High | WaitMode::Rise);
        let name = input.name();
        let changes = self.scenario.inputs.iter().filter(|change| change.input == name);
        let mut changes = changes.filter(|change| change.time > self.time).peekable();
        while let Some(change) = changes.next() {
            // What lasts for no time is not seen.
            if changes.peek().is_some_and(|next| next.time <= change.time) {
                continue;
            }
            let now = is_high(change.value);
            if now != before && now == to_high {
                return Some(change.time);
            }
            before = now;
        }
        None
    }

    /// Whether anything is connected to an input.
    pub(crate) fn is_connected(&self, input: Input) -> bool {
        let name = input.name();
        self.wire(input).is_some() || self.scenario.inputs.iter().any(|change| change.input == name)
    }

    /// The output that is wired to a digital input.
    pub(super) fn wire(&self, input: Input) -> Option<Pin> {
        let Input::Digital(number) = input else { return None };
        let (output, _) =
            self.scenario.wires.iter().find(|(_, wired)| u32::from(**wired) == number)?;
        output.parse().ok().map(Pin::DigitalOut)
    }

    pub(super) fn input_at(&self, input: Input, time: f64) -> f64 {
        let name = input.name();
        let changes = self.scenario.inputs.iter();
        let past = changes.filter(|change| change.input == name && change.time <= time);
        past.map(|change| change.value).next_back().unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use gaugeblock_vocabulary::scenario::{Environment, InputChange};

    use super::*;
    use crate::Choices;

    fn with_input(changes: &[(f64, f64)]) -> EnvironmentState {
        let input = || "digital_in[0]".to_owned();
        let inputs = changes.iter().map(|(time, value)| InputChange {
            time: *time,
            input: input(),
            value: *value,
        });
        let environment = Environment { inputs: inputs.collect(), ..Environment::default() };
        EnvironmentState::new(&environment, 1, &Choices::default())
    }

    #[test]
    fn an_edge_is_a_change_and_a_level_is_none() {
        let environment = with_input(&[(0.0, 1.0), (1.0, 0.0), (2.0, 1.0)]);
        let wait = |mode, timeout| environment.awaited(Input::Digital(0), mode, Some(timeout));
        assert_eq!(wait(WaitMode::High, 5.0), Awaited::Comes { after: 0.0, value: 1.0 });
        assert_eq!(wait(WaitMode::Low, 5.0), Awaited::Comes { after: 1.0, value: 0.0 });
        assert_eq!(wait(WaitMode::Fall, 5.0), Awaited::Comes { after: 1.0, value: 0.0 });
        assert_eq!(wait(WaitMode::Rise, 5.0), Awaited::Comes { after: 2.0, value: 1.0 });
        assert_eq!(wait(WaitMode::Rise, 1.5), Awaited::TimesOut { after: 1.5 });
    }

    #[test]
    fn a_wait_without_end_never_ends() {
        let awaited = with_input(&[]).awaited(Input::Digital(0), WaitMode::High, None);
        assert_eq!(awaited, Awaited::Never);
    }
}
