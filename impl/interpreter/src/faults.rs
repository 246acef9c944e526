//! Planted faults: deliberate mistakes of the interpreter, to see which of them the suite notices.
//!
//! `if planted(PlantedFault::MistStays)` in the interpreter is a place where it can make that mistake. A build for
//! users lacks the feature `faults`: there [`planted`] is constant `false`, and the compiler removes the mistake. With
//! the feature, `plant` switches one mistake on for the whole process, and `gaugeblock suite faults` tries each.
//!
//! A planted fault is no reason to refuse a block: that is [`gaugeblock_vocabulary::FaultKind`].

macro_rules! faults {
    ($($(#[doc = $about:literal])* $name:literal $fault:ident,)*) => {
        /// A deliberate mistake that can be planted in the interpreter.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum PlantedFault {
            $($(#[doc = $about])* $fault,)*
        }

        #[cfg(feature = "faults")]
        impl PlantedFault {
            /// Every fault.
            pub const ALL: &'static [Self] = &[$(Self::$fault),*];

            /// Its name: the chapter of the suite that should notice it, and what is wrong.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$fault => $name,)*
                }
            }

            /// The mistake.
            pub fn about(self) -> &'static str {
                match self {
                    $(Self::$fault => concat!($($about),*).trim_ascii(),)*
                }
            }
        }
    };
}

faults! {
    /// An abort at a pause lets the program go on.
    "abort.resumes" AbortResumes,
    /// DEBUG speaks although the program has silenced it.
    "active-comments.debug-unsilenced" DebugUnsilenced,
    /// The first comment of a block acts instead of the last.
    "active-comments.first-comment" FirstComment,
    /// A line log is written although no file is open.
    "active-comments.log-without-file" LogWithoutFile,
    /// The centre of an arc under G90.1 counts from its start.
    "arcs.absolute-from-start" AbsoluteFromStart,
    /// A negative R is the same arc as a positive one.
    "arcs.negative-radius" NegativeRadius,
    /// An arc may end anywhere.
    "arcs.any-end" AnyEnd,
    /// P of an arc is not looked at.
    "arcs.one-turn" OneTurn,
    /// An arc with R between equal points has a centre that is not a number.
    "arcs.equal-points" EqualPoints,
    /// An offset along the normal of the plane is ignored.
    "arcs.foreign-offset" ForeignOffset,
    /// A radius that does not reach the end makes half a circle.
    "arcs.short-radius" ShortRadius,
    /// P of an arc is truncated to an integer.
    "arcs.turns-cut" TurnsCut,
    /// An else branch is never taken.
    "control.else-skipped" ElseSkipped,
    /// A negative condition is false.
    "control.negative-false" NegativeFalse,
    /// repeat makes one turn too many.
    "control.repeat-once-more" RepeatOnceMore,
    /// A label may be defined twice.
    "control.label-twice" LabelTwice,
    /// continue of a while leaves the loop.
    "control.continue-leaves" ContinueLeaves,
    /// M9 leaves mist on.
    "coolant.mist-stays" MistStays,
    /// G98 goes back to R.
    "cycles.back-to-r" BackToR,
    /// Words of the block before are forgotten.
    "cycles.nothing-sticky" NothingSticky,
    /// L makes one hole too many.
    "cycles.one-more-hole" OneMoreHole,
    /// Under G91 the bottom counts from the point and not from R.
    "cycles.bottom-from-point" BottomFromPoint,
    /// A peck goes to the bottom at once.
    "cycles.no-pecks" NoPecks,
    /// G86 leaves the spindle stopped.
    "cycles.spindle-stays" SpindleStays,
    /// G85, G86 and G89 change the position and make no move.
    "cycles.bore-moves-nothing" BoreMovesNothing,
    /// A canned cycle is accepted under inverse time.
    "cycles.inverse-time" CycleInverseTime,
    /// Under G91 an axis without a word adds its own coordinate.
    "cycles.omitted-axis-adds" OmittedAxisAdds,
    /// G83 feeds from R again after each peck.
    "cycles.peck-from-r" PeckFromR,
    /// L of a canned cycle is kept in eight bits.
    "cycles.repeat-wraps" RepeatWraps,
    /// A later block of a canned cycle may have rotary words.
    "cycles.rotary-later" RotaryLater,
    /// A negative dwell is left out.
    "dwell.negative" NegativeDwell,
    /// Numbers are equal only when all their digits are.
    "expressions.equal-exactly" EqualExactly,
    /// MOD has the sign of the dividend.
    "expressions.modulus-sign" ModulusSign,
    /// A division by zero is zero.
    "expressions.divide-by-zero" DivideByZero,
    /// ATAN takes its numbers the wrong way round.
    "expressions.arctangent-swapped" ArctangentSwapped,
    /// FIX rounds toward zero.
    "expressions.fix-toward-zero" FixTowardZero,
    /// XOR is OR.
    "expressions.xor-as-or" XorAsOr,
    /// AND comes before the comparisons.
    "expressions.and-first" AndFirst,
    /// A modulus of zero gives the dividend.
    "expressions.modulus-by-zero" ModulusByZero,
    /// A negative power of zero is zero.
    "expressions.power-of-zero" PowerOfZero,
    /// L of M98 is not looked at.
    "fanuc-subs.no-repeat" NoRepeat,
    /// M98 works where numbered subprograms are disabled.
    "fanuc-subs.disabled" DisabledFanuc,
    /// M98 counts its turns from zero.
    "fanuc-subs.one-more" OneTurnMore,
    /// P of M98 is kept in sixteen bits.
    "fanuc-subs.number-wraps" SubprogramWraps,
    /// A switch of the feed mode keeps the feed rate.
    "feed.kept-over-mode" FeedKeptOverMode,
    /// A negative feed is taken.
    "feed.negative" NegativeFeed,
    /// A move under inverse time does without F.
    "feed.inverse-time-old" InverseTimeOld,
    /// The first feed rate of a program stays.
    "feed.never-changes" FeedNeverChanges,
    /// A printed member of a modal array stays on.
    "gpp.member-stays" MemberStays,
    /// Identical variables share nothing.
    "gpp.identical-apart" IdenticalApart,
    /// Identical variables are printed in the format of the one that is assigned.
    "gpp.identical-format" IdenticalFormat,
    /// A modal variable that is off is left out in GPP2.
    "gpp.off-left-out" OffLeftOut,
    /// PRINT leaves modal variables on.
    "gpp.print-keeps" PrintKeeps,
    /// A non-modal variable that is printed goes off.
    "gpp.non-modal-off" NonModalOff,
    /// Numbers are compared with all their digits.
    "gpp.compared-exactly" ComparedExactly,
    /// A value that is printed the same is another one all the same.
    "gpp.changed-by-value" ChangedByValue,
    /// A variable that a block of the toolpath does not include stays on.
    "gpp.presence-stays" PresenceStays,
    /// A variable that is assigned its first value stays off.
    "gpp.first-stays-off" FirstStaysOff,
    /// Of a whole array the first member alone is switched.
    "gpp.first-member-only" FirstMemberOnly,
    /// An index is cut off and not rounded.
    "gpp.index-cut" IndexCut,
    /// The newline procedure runs once in an OUTPUT.
    "gpp.newline-once" NewlineOnce,
    /// A tie is rounded toward zero.
    "gpp.tie-toward-zero" TieTowardZero,
    /// Waiting for a falling edge is waiting for the low level.
    "inputs.fall-as-low" FallAsLow,
    /// M66 leaves its result in no parameter.
    "inputs.no-result" NoInputResult,
    /// A wait of zero seconds is taken.
    "inputs.zero-timeout" ZeroTimeout,
    /// A wait for an input that timed out reads zero.
    "inputs.timeout-zero" TimeoutReadsZero,
    /// Of two codes of a modal group the last one counts.
    "modal-groups.last-wins" LastWins,
    /// A word that nothing uses is passed over.
    "modal-groups.unused-word" UnusedWord,
    /// M codes of one group are accepted in one block.
    "modal-groups.m-codes-together" MCodesTogether,
    /// A program begins with another motion mode.
    "modal-groups.begins-with-traverse" BeginsWithTraverse,
    /// G and M numbers are truncated.
    "modal-groups.code-cut" GcodeCut,
    /// G numbers are kept in sixteen bits.
    "modal-groups.g-code-wraps" GcodeWraps,
    /// M numbers are kept in sixteen bits.
    "modal-groups.m-code-wraps" McodeWraps,
    /// Axis words after G80 move as the mode before.
    "motion.after-cancel" AfterCancel,
    /// A rapid move needs a feed rate.
    "motion.traverse-needs-feed" TraverseNeedsFeed,
    /// A sixth bracket is accepted within five.
    "nct.six-brackets" SixBrackets,
    /// What a macro has assigned stays in its caller's variables.
    "nct.locals-not-restored" LocalsNotRestored,
    /// Vacant variables are zero after a call.
    "nct.vacancy-lost" VacancyLost,
    /// A level begins with what the last macro there has left.
    "nct.stale-locals" StaleLocals,
    /// G67 cancels the modal call that was commanded first.
    "nct.cancels-first" CancelsFirst,
    /// The blocks of a macro reach the modal call that has called it.
    "nct.reaches-itself" ReachesItself,
    /// Of several modal calls the one that was commanded first is called.
    "nct.oldest-first" OldestFirst,
    /// There is a fifth macro level.
    "nct.fifth-level" FifthLevel,
    /// A call is repeated once too often.
    "nct.once-more" OnceMore,
    /// In comparisons vacant is zero.
    "nct.vacant-is-zero" VacantIsZero,
    /// A word with a vacant value is zero.
    "nct.vacant-word-zero" VacantWordZero,
    /// A subprogram has local variables of its own.
    "nct.sub-has-locals" SubHasLocals,
    /// M99 P searches the program that it ends.
    "nct.return-within" ReturnWithin,
    /// A code is cut off and not rounded.
    "nct.code-cut" CodeCut,
    /// The number after GOTO is truncated and not rounded.
    "nct.label-cut" LabelCut,
    /// A block that a modal call takes as arguments is executed all the same.
    "nct.block-executed-too" BlockExecutedToo,
    /// A point without a digit is zero.
    "numbers.point-alone" PointAlone,
    /// A number may have two signs.
    "numbers.two-signs" TwoSigns,
    /// G53 adds its words where the distance is incremental.
    "offsets.machine-incremental" MachineIncremental,
    /// A work coordinate system is turned the wrong way.
    "offsets.rotation-reversed" RotationReversed,
    /// G10 L2 of the active system waits for its selection.
    "offsets.active-waits" ActiveWaits,
    /// G59.3 selects G59.2.
    "offsets.last-system" LastSystem,
    /// L of G10 is kept in eight bits.
    "offsets.kind-wraps" OffsetKindWraps,
    /// G53 is accepted without axis words.
    "offsets.machine-without-axes" MachineWithoutAxes,
    /// A coordinate system can be selected while the cutter is compensated.
    "offsets.select-compensated" SelectCompensated,
    /// G10 L2 without P sets the active coordinate system.
    "offsets.set-without-system" SetWithoutSystem,
    /// P of G10 is kept in eight bits.
    "offsets.system-wraps" OffsetSystemWraps,
    /// M codes of a block are executed by number.
    "order.by-number" ByNumber,
    /// A dwell comes after the other G codes of its block.
    "order.dwell-late" DwellLate,
    /// F is read after the length unit of its block has been set.
    "order.feed-after-units" FeedAfterUnits,
    /// The angle of M19 has no offset.
    "orient.no-offset" NoOrientOffset,
    /// R360 is refused.
    "orient.full-turn-refused" FullTurnRefused,
    /// A spindle that was oriented turns on.
    "orient.turns-on" OrientTurnsOn,
    /// A spindle at its angle is still commanded to turn there.
    "orient.request-stays" OrientRequestStays,
    /// M64 waits for the next motion.
    "outputs.on-waits" OnWaits,
    /// There is one output more than the machine has.
    "outputs.one-more" OneOutputMore,
    /// M68 is M67.
    "outputs.analog-waits" AnalogWaits,
    /// Of several settings that wait for a motion the first one counts.
    "outputs.first-counts" FirstWaitingCounts,
    /// The number of an input or output is kept in eight bits.
    "outputs.number-wraps" OutputWraps,
    /// M49 leaves the speed override alone.
    "overrides.speed-untouched" SpeedUntouched,
    /// M50 without P disables.
    "overrides.default-off" DefaultOff,
    /// M52 switches the feed stop.
    "overrides.wrong-switch" WrongSwitch,
    /// A disabled speed override counts.
    "overrides.speed-always" OverrideAlwaysCounts,
    /// The feed stop stops motion although it is disabled.
    "overrides.stop-always" StopNeverDisabled,
    /// Settings of a block take effect from right to left.
    "parameters.right-to-left" RightToLeft,
    /// `_metric` says whether inches are in force.
    "parameters.metric-inverted" MetricInverted,
    /// Local names are seen in the subs that are called.
    "parameters.locals-inherited" LocalsInherited,
    /// A global parameter that is not there is zero.
    "parameters.absent-is-zero" AbsentIsZero,
    /// M66 brings no HAL item up to date.
    "parameters.items-old" ItemsNeverNew,
    /// `_spindle_cw` reports the other direction.
    "parameters.clockwise-inverted" ClockwiseInverted,
    /// The number of a parameter is truncated.
    "parameters.index-cut" ParameterCut,
    /// The number of a parameter is kept in sixteen bits.
    "parameters.number-wraps" ParameterWraps,
    /// A setting of a predefined parameter is accepted, and lost.
    "parameters.read-only-assigned" ReadOnlyAssigned,
    /// G64 without P keeps the tolerance.
    "path-control.tolerance-kept" ToleranceKept,
    /// G64 P without Q has no naive CAM tolerance.
    "path-control.no-naive-tolerance" NoNaiveTolerance,
    /// M1 stops whatever the switch says.
    "pause.not-optional" NotOptional,
    /// M60 exchanges no pallets.
    "pause.no-pallets" NoPallets,
    /// A paused program does not keep the controller in auto mode.
    "pause.mode-changes" ModeWhilePaused,
    /// The point on the way to a predefined position is left out.
    "positions.straight" StraightToPosition,
    /// G30 goes where G28 goes.
    "positions.one-position" OnePosition,
    /// Axes without a word go to the predefined position too.
    "positions.all-axes" AllAxes,
    /// A probe without contact is not an error.
    "probe.miss-accepted" MissAccepted,
    /// G38.4 looks for contact as G38.2 does.
    "probe.toward-only" TowardOnly,
    /// #5070 does not say whether the probe changed.
    "probe.no-result" NoProbeResult,
    /// Coolant flows on after the program's end.
    "program-end.coolant-on" CoolantOn,
    /// G91 stays after the program's end.
    "program-end.incremental-stays" IncrementalStays,
    /// The work coordinate system stays after the program's end.
    "program-end.system-stays" SystemStays,
    /// Cycle start leaves the controller in MDI mode.
    "program-end.starts-in-mode" StartsInMode,
    /// M2 leaves the motion mode.
    "program-end.motion-stays" MotionStays,
    /// M71 does nothing.
    "saved-state.not-invalidated" NotInvalidated,
    /// M73 saves and does not restore.
    "saved-state.no-autorestore" NoAutorestore,
    /// The feed is not restored.
    "saved-state.feed-not-restored" FeedNotRestored,
    /// A sub's save is its caller's.
    "saved-state.one-level" OneLevel,
    /// Modes are restored before the units are.
    "saved-state.units-forgotten" UnitsForgotten,
    /// M72 leaves the override switches.
    "saved-state.overrides-not-restored" OverridesNotRestored,
    /// M72 without a saved state is accepted.
    "saved-state.restores-nothing" RestoresNothing,
    /// M4 is M3.
    "spindle.one-direction" OneDirection,
    /// S without $ is for every spindle.
    "spindle.speed-for-all" SpeedForAll,
    /// A negative speed is taken.
    "spindle.negative-speed" NegativeSpeed,
    /// D of G96 is not looked at.
    "spindle.no-limit" NoSpindleLimit,
    /// A spindle at a speed of zero is commanded to turn.
    "spindle.on-at-zero" OnAtZero,
    /// G5 has a control point too few.
    "splines.quadratic-only" QuadraticOnly,
    /// A spline works in any plane.
    "splines.any-plane" AnySplinePlane,
    /// I and J of G5.1 may both be zero.
    "splines.zero-offsets" ZeroOffsets,
    /// A sub may call eleven levels deep.
    "subroutines.eleven-levels" ElevenLevels,
    /// The value of a return is lost.
    "subroutines.value-lost" ValueLost,
    /// Parameters of the caller are those of the sub.
    "subroutines.arguments-kept" ArgumentsKept,
    /// Arguments begin at #2.
    "subroutines.arguments-shifted" ArgumentsShifted,
    /// The number of a sub is kept in sixteen bits.
    "subroutines.number-wraps" LabelWraps,
    /// A block by hand is executed in auto mode.
    "task.entered-in-auto" EnteredInAuto,
    /// A slash deletes no block.
    "text.nothing-deleted" NothingDeleted,
    /// A line may be of any length.
    "text.any-length" AnyLength,
    /// The second percent line does not end a program.
    "text.percent-goes-on" PercentGoesOn,
    /// A synchronised move is accepted while the spindle is stopped.
    "threading.standing-spindle" StandingSpindle,
    /// G76 makes no spring passes.
    "threading.no-spring-passes" NoSpringPasses,
    /// Depths of G76 are radii under G7.
    "threading.depth-as-radius" DepthAsRadius,
    /// The spindle turns on over a tool change.
    "tool.spindle-turns-on" SpindleTurnsOn,
    /// A tool stays selected after its change.
    "tool.stays-selected" StaysSelected,
    /// Offsets of the tool table are taken in the active unit.
    "tool.offset-unit" OffsetUnit,
    /// M61 takes any number.
    "tool.set-unknown" SetUnknown,
    /// H and D are kept in eight bits.
    "tool.length-wraps" LengthWraps,
    /// T is kept in eight bits.
    "tool.number-wraps" ToolWraps,
    /// A change of unit leaves the number of the feed.
    "units-planes.feed-number" FeedNumber,
    /// An X word under G7 is a radius.
    "units-planes.diameter-as-radius" DiameterAsRadius,
    /// G19 selects the plane of G18.
    "units-planes.wrong-plane" WrongPlane,
    /// A change of unit leaves the numbers of the position.
    "units-planes.position-kept" PositionKept,
    /// P and Q of a user-defined code change places.
    "user-codes.swapped" SwappedArguments,
}

#[cfg(feature = "faults")]
mod planting {
    use core::sync::atomic::{AtomicUsize, Ordering};

    use super::PlantedFault;

    /// The planted fault as its place among all, or none.
    static PLANTED: AtomicUsize = AtomicUsize::new(usize::MAX);

    /// Plants a fault in every interpreter of the process, or takes it out again.
    pub fn plant(fault: Option<PlantedFault>) {
        let place = fault.and_then(|fault| PlantedFault::ALL.iter().position(|one| *one == fault));
        PLANTED.store(place.unwrap_or(usize::MAX), Ordering::SeqCst);
    }

    /// Whether this fault is planted.
    pub(crate) fn planted(fault: PlantedFault) -> bool {
        PlantedFault::ALL.get(PLANTED.load(Ordering::Relaxed)) == Some(&fault)
    }
}

#[cfg(feature = "faults")]
pub use planting::plant;
#[cfg(feature = "faults")]
pub(crate) use planting::planted;

/// What is left of a number in an integer that has so many values, if that fault is planted.
#[inline]
pub(crate) fn narrowed(fault: PlantedFault, number: f64, values: f64) -> f64 {
    if planted(fault) && number >= values { crate::math::remainder(number, values) } else { number }
}

/// Whether this fault is planted: no.
#[cfg(not(feature = "faults"))]
#[inline(always)]
pub(crate) const fn planted(_fault: PlantedFault) -> bool {
    false
}
