//! Effects: what a program does to the world, in order. Positions are program coordinates in the active length unit.

use alloc::string::String;
use alloc::vec::Vec;

#[cfg(feature = "text")]
use crate::error::TextError;
use crate::field::{Argument, Value};
use crate::modes::ControllerMode;
use crate::position::Position;
#[cfg(feature = "text")]
use crate::text::line::Arguments;
use crate::words::words;

words! {
    /// Where a message is displayed.
    pub enum Channel {
        /// The operator's display: (MSG,…) and (DEBUG,…).
        Display = "display",
        /// The console: (PRINT,…).
        Print = "print",
        /// The open log file: (LOG,…).
        Log = "log",
        /// Output of a post-processor: OUTPUT and PRINT of GPP.
        Output = "output",
    }
}
words! {
    /// What M66 waits for.
    pub enum WaitMode {
        /// L0: not at all.
        Immediate = "immediate",
        /// L1: a rising edge.
        Rise = "rise",
        /// L2: a falling edge.
        Fall = "fall",
        /// L3: the high level.
        High = "high",
        /// L4: the low level.
        Low = "low",
    }
}
words! {
    /// When an output switches.
    pub enum OutputTiming {
        /// With the start of the next motion (M62, M63, M67).
        WithMotion = "with_motion",
        /// At once (M64, M65, M68).
        AtOnce = "at_once",
    }
}
words! {
    /// Which way a spindle turns to its angle.
    pub enum OrientDirection {
        /// P0 of M19.
        Shortest = "shortest",
        /// P1 of M19.
        Clockwise = "clockwise",
        /// P2 of M19.
        Counterclockwise = "counterclockwise",
    }
}

words! {
    /// A request of an operator to a controller.
    pub enum Request {
        /// Start the program, or start it again.
        CycleStart = "cycle_start",
        /// Pause.
        Pause = "pause",
        /// Resume.
        Resume = "resume",
        /// Abort.
        Abort = "abort",
        /// Change the mode of the controller.
        Mode = "mode",
        /// Execute a block that is entered by hand.
        Mdi = "mdi",
    }
}

macro_rules! effects {
    ($($(#[$about:meta])* $name:literal $variant:ident { $($(#[$what:meta])* $field:ident: $type:ty,)* })*) => {
        /// Something that a program does, with program coordinates in the active length unit.
        #[derive(Clone, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize), serde(tag = "effect", deny_unknown_fields))]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        pub enum Effect {
            $(
                $(#[$about])*
                #[cfg_attr(feature = "serde", serde(rename = $name))]
                $variant {
                    $(
                        $(#[$what])*
                        #[cfg_attr(feature = "serde", serde(serialize_with = "crate::json::number::write"))]
                        $field: $type,
                    )*
                },
            )*
        }

        #[cfg(feature = "serde")]
        impl<'de> serde::Deserialize<'de> for Effect {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                use crate::json::number::JsonValue;

                #[derive(serde::Deserialize)]
                #[serde(deny_unknown_fields)]
                enum Wire {
                    $(#[serde(rename = $name)] $variant { $($field: <$type as JsonValue>::Read,)* },)*
                }
                Ok(match crate::json::tagged::read(deserializer, "effect")? {
                    $(Wire::$variant { $($field),* } => Self::$variant { $($field: JsonValue::of($field)),* },)*
                })
            }
        }

        impl Effect {
            /// The names of all effects.
            pub const NAMES: &'static [&'static str] = &[$($name),*];

            /// The effect's name, such as `straight_feed`.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant { .. } => $name,)*
                }
            }

            /// Its arguments that were written, by name, in order.
            pub fn arguments(&self) -> Vec<(&'static str, Value)> {
                match self {
                    $(Self::$variant { $($field),* } => {
                        let arguments: Vec<(&'static str, Option<Value>)> =
                            alloc::vec![$((stringify!($field), Argument::written($field))),*];
                        arguments.into_iter().filter_map(|(name, value)| Some((name, value?))).collect()
                    })*
                }
            }

            /// Reads an effect from its name and arguments.
            ///
            /// # Errors
            /// No such effect, or an argument is missing, unreadable or unknown.
            #[cfg(feature = "text")]
            pub fn read(name: &str, mut arguments: Arguments) -> Result<Self, TextError> {
                let effect = match name {
                    $($name => Self::$variant { $($field: arguments.take(stringify!($field))?),* },)*
                    _ => return Err(TextError::new(alloc::format!("there is no effect named {name}"))),
                };
                arguments.finish()?;
                Ok(effect)
            }
        }
    };
}

effects! {
    /// G0: a straight move at rapid speed.
    "straight_traverse" StraightTraverse {
        /// End point.
        end: Position,
    }
    /// G1: a straight move at feed speed.
    "straight_feed" StraightFeed {
        /// End point.
        end: Position,
    }
    /// G2, G3: an arc or helix in the selected plane at feed speed.
    "arc_feed" ArcFeed {
        /// End point, all axes.
        end: Position,
        /// Centre along the plane's first axis.
        first_centre: f64,
        /// Centre along the plane's second axis.
        second_centre: f64,
        /// Turns, positive counterclockwise, negative clockwise; 1 is up to a full circle.
        turns: i32,
    }
    /// G5, G5.1, G5.2: a spline through control points in the XY plane.
    "nurbs_feed" NurbsFeed {
        /// How many control points.
        points: u32,
        /// End point.
        end: Position,
    }
    /// G38.n: a straight move until a probe changes.
    "straight_probe" StraightProbe {
        /// Farthest point.
        end: Position,
        /// Where the probe changed; absent when it did not.
        contact: Option<Position>,
    }
    /// G33.1, G84: feed synchronised with the spindle, reversing at the end.
    "rigid_tap" RigidTap {
        /// End point.
        end: Position,
    }
    /// G33, G76: feed per revolution, synchronised from here.
    "start_spindle_synchronisation" StartSpindleSynchronisation {
        /// Spindle number.
        spindle: u32,
        /// Length unit per revolution.
        pitch: f64,
    }
    /// The end of synchronised feed.
    "stop_spindle_synchronisation" StopSpindleSynchronisation {}
    /// G4: a pause of a given time.
    "dwell" Dwell {
        /// Seconds.
        seconds: f64,
    }
    /// T: prepare a tool.
    "prepare_tool" PrepareTool {
        /// Tool number.
        tool: i32,
    }
    /// M6 where tools are changed by hand: prompt for a tool.
    "prompt_tool" PromptTool {
        /// Tool number; 0 for none.
        tool: i32,
    }
    /// M6: put the prepared tool into the spindle.
    "change_tool" ChangeTool {
        /// Tool number; 0 for none.
        tool: i32,
    }
    /// M61: say which tool is in the spindle.
    "set_tool_number" SetToolNumber {
        /// Tool number; 0 for none.
        tool: i32,
    }
    /// G10 L1, L10, L11: write into the tool table.
    "set_tool_entry" SetToolEntry {
        /// Tool number.
        tool: i32,
        /// Offsets.
        offset: Position,
        /// Diameter, length unit.
        diameter: f64,
        /// Front angle, degrees.
        front_angle: f64,
        /// Back angle, degrees.
        back_angle: f64,
        /// Orientation of a lathe tool, 0 to 9.
        orientation: i32,
    }
    /// M19: turn a spindle to an angle.
    "orient_spindle" OrientSpindle {
        /// Spindle number.
        spindle: u32,
        /// Degrees.
        angle: f64,
        /// Direction of rotation.
        direction: OrientDirection,
    }
    /// M19 with Q: wait until a spindle is at its angle.
    "wait_orient" WaitOrient {
        /// Spindle number.
        spindle: u32,
        /// Longest wait, seconds.
        timeout: f64,
    }
    /// M62 to M65: switch a digital output.
    "set_digital_output" SetDigitalOutput {
        /// Output number.
        output: i32,
        /// On or off.
        on: bool,
        /// With the next motion or at once.
        timing: OutputTiming,
    }
    /// M67, M68: set an analog output.
    "set_analog_output" SetAnalogOutput {
        /// Output number.
        output: i32,
        /// Value of the output, in units of the output.
        to: f64,
        /// With the next motion or at once.
        timing: OutputTiming,
    }
    /// M66: read or wait for an input.
    "wait_input" WaitInput {
        /// Digital input number.
        digital: Option<i32>,
        /// Analog input number.
        analog: Option<i32>,
        /// The condition that ends the wait.
        mode: WaitMode,
        /// Longest wait, seconds.
        timeout: Option<f64>,
        /// What was read; -1 after a time-out.
        read: f64,
    }
    /// M100 to M199: run a user-defined program.
    "user_code" UserCode {
        /// 100 to 199.
        code: u32,
        /// First argument as text.
        p: String,
        /// Second argument as text.
        q: String,
    }
    /// M0, M1, M60: stop until the operator resumes.
    "stop" Stop {
        /// M1: only while the optional-stop switch is on.
        optional: bool,
    }
    /// M30, M60: exchange pallets.
    "pallet_shuttle" PalletShuttle {}
    /// A text for a person.
    "message" Message {
        /// Where the text is displayed.
        channel: Channel,
        /// The text, parameters expanded.
        text: String,
    }
    /// (LOGOPEN,…) and (LOGAPPEND,…).
    "log_open" LogOpen {
        /// File name as the program writes it; nothing is written there.
        file: String,
        /// Whether an existing file is continued.
        append: bool,
    }
    /// (LOGCLOSE).
    "log_close" LogClose {}
    /// (PROBEOPEN …).
    "probe_log_open" ProbeLogOpen {
        /// File name as the program writes it; nothing is written there.
        file: String,
    }
    /// (PROBECLOSE).
    "probe_log_close" ProbeLogClose {}
    /// The controller changes its mode.
    "controller_mode" ChangeControllerMode {
        /// The new mode.
        mode: ControllerMode,
    }
    /// The controller refuses a request of the operator.
    "request_refused" RequestRefused {
        /// The refused request.
        request: Request,
    }
    /// M2, M30: the program is over.
    "program_end" ProgramEnd {}
}
