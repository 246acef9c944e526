//! What the writer knows of the program so far: enough for most blocks to be allowed. It is not an interpreter.

use gaugeblock_vocabulary::{Axis, Scenario};

/// A sub that can be called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Sub {
    /// Its text after the letter O: `101` or `<cave>`.
    pub(crate) label: String,
    /// Whether M98 calls it rather than an o-word.
    pub(crate) numbered: bool,
}

/// What is known at a place of a program.
#[derive(Clone, Debug)]
pub(crate) struct State {
    /// Axis letters of the machine.
    pub(crate) axes: Vec<&'static str>,
    /// Number of spindles.
    pub(crate) spindles: u32,
    /// Inputs and outputs of each kind.
    pub(crate) io: u32,
    /// Tool numbers of the tool table.
    pub(crate) tools: Vec<u32>,
    /// User-defined codes that can run.
    pub(crate) user_codes: Vec<u32>,
    /// Whether M98 and M99 are enabled.
    pub(crate) fanuc: bool,
    /// Whether F is set under units per minute.
    pub(crate) feed: bool,
    /// Whether the feed mode is units per minute.
    pub(crate) per_minute: bool,
    /// Whether the last motion code was G0 or G1, so that axis words may stand alone.
    pub(crate) moving: bool,
    /// Whether that was G0.
    pub(crate) rapid: bool,
    /// Whether the plane is XY.
    pub(crate) xy_plane: bool,
    /// Whether modes are saved at this call level.
    pub(crate) saved: bool,
    /// Whether a tool is selected.
    pub(crate) selected: bool,
    /// Whether a tool was changed to.
    pub(crate) loaded: bool,
    /// Whether the first spindle turns at a speed.
    pub(crate) turning: bool,
    /// Named parameters that exist here.
    pub(crate) names: Vec<String>,
    /// Subs that were defined before.
    pub(crate) subs: Vec<Sub>,
    /// Labels of the loops around this place, outermost first.
    pub(crate) loops: Vec<u32>,
    /// Structures around this place.
    pub(crate) depth: u32,
    /// Within a sub or subroutine file.
    pub(crate) in_sub: bool,
    /// Within a branch or loop, so that nothing may be defined.
    pub(crate) nested: bool,
    /// Whether lathe cycles with arcs have no distance: LinuxCNC's program prints a message when it drops a piece.
    pub(crate) no_arcs_at_distance: bool,
}

impl State {
    /// Before the first block.
    pub(crate) fn of(scenario: &Scenario) -> Self {
        let machine = &scenario.machine;
        let user = &scenario.environment.user_programs;
        let number = |file: &str| file.strip_prefix('M').and_then(|text| text.parse().ok());
        Self {
            axes: machine.axes.iter().map(|axis| letter(*axis)).collect(),
            spindles: u32::from(machine.spindles),
            io: u32::from(machine.digital_io.min(machine.analog_io)),
            tools: machine.tools.iter().map(|tool| tool.number).collect(),
            user_codes: user.iter().filter_map(|program| number(&program.file)).collect(),
            fanuc: machine.fanuc_subs,
            feed: false,
            per_minute: true,
            moving: false,
            rapid: false,
            xy_plane: true,
            saved: false,
            selected: false,
            loaded: false,
            turning: false,
            names: Vec::new(),
            subs: Vec::new(),
            loops: Vec::new(),
            depth: 0,
            in_sub: false,
            nested: false,
            no_arcs_at_distance: false,
        }
    }

    /// Whether the machine has the axes X and Y, which arcs and canned cycles name.
    pub(crate) fn has_xy(&self) -> bool {
        ["x", "y"].iter().all(|axis| self.axes.contains(axis))
    }

    /// What is known after a body that may have run or not.
    pub(crate) fn join(&mut self, before: &Self) {
        self.feed &= before.feed;
        self.per_minute &= before.per_minute;
        self.moving &= before.moving;
        self.rapid &= before.rapid;
        self.xy_plane &= before.xy_plane;
        self.saved &= before.saved;
        self.selected &= before.selected;
        self.loaded &= before.loaded;
        self.turning &= before.turning;
        self.names.retain(|name| before.names.contains(name));
        self.loops.clone_from(&before.loops);
        self.depth = before.depth;
        self.in_sub = before.in_sub;
        self.nested = before.nested;
    }

    /// Nothing of the modes is known for sure, as after a call.
    pub(crate) fn forget_modes(&mut self) {
        self.feed = false;
        self.moving = false;
        self.selected = false;
        self.turning = false;
        self.xy_plane = false;
    }
}

fn letter(axis: Axis) -> &'static str {
    match axis {
        Axis::X => "x",
        Axis::Y => "y",
        Axis::Z => "z",
        Axis::A => "a",
        Axis::B => "b",
        Axis::C => "c",
        Axis::U => "u",
        Axis::V => "v",
        Axis::W => "w",
    }
}
