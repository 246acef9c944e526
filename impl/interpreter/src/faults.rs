//! Planted faults: deliberate mistakes of the interpreter, to see which of them the suite notices.
//!
//! `if planted(PlantedFault::MistStays)` in the interpreter is a place where it can make that mistake. A build for
//! users lacks the feature `faults`: there [`planted`] is constant `false`, and the compiler removes the mistake. With
//! the feature, `plant` switches one mistake on for the whole process, and `gaugeblock suite faults` tries each.
//!
//! A planted fault is no reason to refuse a block: that is [`gaugeblock_vocabulary::FaultKind`].

macro_rules! faults {
    ($($name:literal $fault:ident $about:literal,)*) => {
        /// A deliberate mistake that can be planted in the interpreter.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum PlantedFault {
            $(#[doc = $about] $fault,)*
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
                    $(Self::$fault => $about,)*
                }
            }
        }
    };
}

faults! {
    "abort.resumes" AbortResumes "An abort at a pause lets the program go on.",
    "active-comments.debug-unsilenced" DebugUnsilenced "DEBUG speaks although the program has silenced it.",
    "active-comments.first-comment" FirstComment "The first comment of a block acts instead of the last.",
    "active-comments.format-once" FormatOnce "A format counts for one parameter only.",
    "active-comments.integer-cut" IntegerCut "%d cuts the decimals off instead of rounding.",
    "active-comments.log-without-file" LogWithoutFile "A line log is written although no file is open.",
    "active-comments.spaced-name-absent" SpacedNameAbsent "A name with blanks in a comment names no parameter.",
    "active-comments.zero-decimals" ZeroDecimals "%.0f is printed as characters.",
    "arcs.absolute-from-start" AbsoluteFromStart "The centre of an arc under G90.1 counts from its start.",
    "arcs.any-end" AnyEnd "An arc may end anywhere.",
    "arcs.equal-points" EqualPoints "An arc with R between equal points has a centre that is not a number.",
    "arcs.fine-limit-unit" FineLimitUnit "The fine limit of the radii of an arc is 0.005 in inches too.",
    "arcs.foreign-offset" ForeignOffset "An offset along the normal of the plane is ignored.",
    "arcs.increments-reset-offsets" IncrementsResetOffsets "G91 also makes arc offsets incremental.",
    "arcs.negative-radius" NegativeRadius "A negative R is the same arc as a positive one.",
    "arcs.no-coarse-limit" NoCoarseLimit "A thousandth of the radius is accepted even where it is more than 0.5 mm.",
    "arcs.one-absolute-offset" OneAbsoluteOffset "Under G90.1 one offset is enough outside of the XY plane.",
    "arcs.one-turn" OneTurn "P of an arc is ignored.",
    "arcs.radius-needs-xy" RadiusNeedsXy "An arc with R needs an X or Y word in every plane.",
    "arcs.return-refused" ArcReturnRefused "An arc in centre format is refused that ends by its words where it begins.",
    "arcs.short-radius" ShortRadius "A radius that does not reach the end makes half a circle.",
    "arcs.turns-cut" TurnsCut "P of an arc is truncated to an integer.",
    "compensation.arc-after-off" ArcAfterOff "An arc right after G40 is accepted.",
    "compensation.depth-lost-on-arcs" DepthLostOnArcs "A compensated arc does not move the axis out of the plane.",
    "compensation.dynamic-in-yz" DynamicInYz "G41.1 and G42.1 are accepted in the YZ plane.",
    "compensation.dynamic-orientation-of-tool" DynamicOrientationOfTool
        "G41.1 and G42.1 without L use the orientation of the loaded tool.",
    "compensation.entry-needs-diameter" EntryNeedsDiameter
        "An entry move shorter than the cutter's diameter is refused.",
    "compensation.inside-corner-to-end" InsideCornerToEnd
        "A move before an inside corner goes to the end of its compensated line.",
    "compensation.kept-after-end" CompensationKept "M2 and M30 leave cutter compensation on.",
    "compensation.negative-diameter-absolute" NegativeDiameterAbsolute
        "A negative diameter of the tool table counts as a positive one.",
    "compensation.other-side-replaces" OtherSideReplaces
        "The code of the other side while compensation is on changes the side.",
    "compensation.outside-corner-mitred" OutsideCornerMitred
        "At an outside corner two lines go on to where they cross.",
    "compensation.radius-of-selected-tool" RadiusOfSelectedTool "G41 and G42 without D use the tool that T selected.",
    "compensation.radius-of-spindle-tool" RadiusOfSpindleTool
        "G41 and G42 use the loaded tool although D names another one.",
    "compensation.rapid-entry-on-path" RapidEntryOnPath "A rapid entry move leads to the programmed point itself.",
    "compensation.sides-by-word-order" SidesByWordOrder "In the XZ plane G41 is on the right and G42 on the left.",
    "compensation.tight-arc-accepted" TightArcAccepted
        "An arc around the cutter may have a radius less than the cutter's.",
    "control.break-tests-do" BreakTestsDo "A break in a do loop goes to the condition, as a continue does.",
    "control.continue-leaves" ContinueLeaves "continue of a while leaves the loop.",
    "control.continue-untested" ContinueUntested "A continue in a do loop begins the next turn without its condition.",
    "control.else-skipped" ElseSkipped "An else branch is never taken.",
    "control.label-twice" LabelTwice "A label may be defined twice.",
    "control.later-conditions" LaterConditions
        "After a branch is executed the condition of the next elseif is evaluated.",
    "control.negative-false" NegativeFalse "A negative condition is false.",
    "control.one-elseif" OneElseIf "Only the first elseif of a condition is looked at.",
    "control.repeat-breaks" RepeatBreaks "A break may point to a repeat.",
    "control.repeat-keeps-count" RepeatKeepsCount "A repeat that is executed again makes no more turns than were left.",
    "control.repeat-once-more" RepeatOnceMore "repeat makes one turn too many.",
    "control.stray-endif" StrayEndIf "An endif without its if is accepted.",
    "coolant.mist-after-flood" MistAfterFlood "M7 does nothing while flood is on.",
    "coolant.mist-stays" MistStays "M9 leaves mist on.",
    "cycles.again-without-axes" AgainWithoutAxes "The code of the cycle in force needs no axis word.",
    "cycles.back-to-r" BackToR "G98 goes back to R.",
    "cycles.bore-moves-nothing" BoreMovesNothing "G85, G86 and G89 change the position and make no move.",
    "cycles.bottom-from-point" BottomFromPoint "Under G91 the bottom counts from the point and not from R.",
    "cycles.cancel-keeps-level" CancelKeepsLevel "G80 does not reset the initial level.",
    "cycles.depth-across-cycles" DepthAcrossCycles "A cycle without its depth takes that of another cycle before.",
    "cycles.equal-levels" EqualLevels "A cycle whose R equals its Z is refused.",
    "cycles.families-mixed" FamiliesMixed "X, Y and Z words of a cycle in the UV, WU and VW planes are ignored.",
    "cycles.inverse-time" CycleInverseTime "A canned cycle is accepted under inverse time.",
    "cycles.no-pecks" NoPecks "A peck goes to the bottom at once.",
    "cycles.nothing-sticky" NothingSticky "Words of the block before are forgotten.",
    "cycles.omitted-axis-adds" OmittedAxisAdds "Under G91 an axis without a word adds its own coordinate.",
    "cycles.one-more-hole" OneMoreHole "L makes one hole too many.",
    "cycles.peck-from-r" PeckFromR "G83 feeds from R again after each peck.",
    "cycles.peck-to-clear" PeckToClear "G83 under G98 retracts to the initial level after each peck.",
    "cycles.repeat-wraps" RepeatWraps "L of a canned cycle is kept in eight bits.",
    "cycles.repeats-sticky" RepeatsSticky "L of a cycle holds for the following blocks of it too.",
    "cycles.restarts-clockwise" RestartsClockwise "G86 restarts a spindle clockwise that turned counterclockwise.",
    "cycles.return-switch-resets" ReturnSwitchResets "G98 or G99 in a series of cycles sets the initial level anew.",
    "cycles.rise-xy-only" RiseXyOnly "Only in the XY plane does a cycle rise to R before it goes to its hole.",
    "cycles.rotary-later" RotaryLater "A later block of a canned cycle may have rotary words.",
    "cycles.spindle-stays" SpindleStays "G86 leaves the spindle stopped.",
    "cycles.stop-before-dwell" StopBeforeDwell "G86 stops the spindle before it dwells.",
    "cycles.tap-enables" TapEnables "G84 enables the overrides at its end even if they were disabled before.",
    "dwell.negative" NegativeDwell "A negative dwell is left out.",
    "expressions.add-first" AddFirst "An addition comes before the subtraction on its left.",
    "expressions.and-first" AndFirst "AND comes before the comparisons.",
    "expressions.arctangent-swapped" ArctangentSwapped "ATAN takes its numbers in the wrong order.",
    "expressions.divide-by-zero" DivideByZero "A division by zero is zero.",
    "expressions.equal-exactly" EqualExactly "Numbers are equal only when all their digits are.",
    "expressions.equality-last" EqualityLast "EQ and NE come after GT, GE, LT and LE.",
    "expressions.fix-toward-zero" FixTowardZero "FIX rounds toward zero.",
    "expressions.modulus-among-sums" ModulusAmongSums "MOD is in the precedence group of + and -.",
    "expressions.modulus-by-zero" ModulusByZero "A modulus of zero gives the dividend.",
    "expressions.modulus-sign" ModulusSign "MOD has the sign of the dividend.",
    "expressions.or-on-integers" OrOnIntegers "OR truncates its operands to integers.",
    "expressions.power-from-right" PowerFromRight "Of several powers the one on the right is computed first.",
    "expressions.power-of-zero" PowerOfZero "A negative power of zero is zero.",
    "expressions.xor-as-or" XorAsOr "XOR computes OR.",
    "fanuc-subs.disabled" DisabledFanuc "M98 works where numbered subprograms are disabled.",
    "fanuc-subs.earlier-called" EarlierCalled "M98 within a subprogram calls one that comes before it in the file.",
    "fanuc-subs.no-repeat" NoRepeat "L of M98 is ignored.",
    "fanuc-subs.number-wraps" SubprogramWraps "P of M98 is kept in sixteen bits.",
    "fanuc-subs.one-more" OneTurnMore "M98 counts its turns from zero.",
    "fanuc-subs.return-ends-sub" ReturnEndsSub "M99 returns from a sub of o-words.",
    "fanuc-subs.thirtieth-local" ThirtiethLocal "M99 restores parameter 30.",
    "fanuc-subs.zero-is-once" ZeroIsOnce "M98 L0 executes the subprogram once.",
    "feed.explicit-only" ExplicitOnly "Under inverse time a block that repeats its move without a G word needs no F.",
    "feed.ignored-rate-kept" IgnoredRateKept "Under G93 the F of a line without a feed move sets the feed rate.",
    "feed.inverse-time-old" InverseTimeOld "A move under inverse time needs no F.",
    "feed.kept-over-mode" FeedKeptOverMode "A switch of the feed mode keeps the feed rate.",
    "feed.negative" NegativeFeed "A negative feed is accepted.",
    "feed.never-changes" FeedNeverChanges "The first feed rate of a program stays.",
    "gpp.changed-by-value" ChangedByValue "A value that prints the same text counts as a change.",
    "gpp.compared-exactly" ComparedExactly "Numbers are compared with all their digits.",
    "gpp.first-member-only" FirstMemberOnly "Of a whole array the first member alone is switched.",
    "gpp.first-stays-off" FirstStaysOff "A variable that is assigned its first value stays off.",
    "gpp.identical-apart" IdenticalApart "Identical variables share nothing.",
    "gpp.identical-format" IdenticalFormat "Identical variables are printed in the format of the one that is assigned.",
    "gpp.index-cut" IndexCut "An index is truncated and not rounded.",
    "gpp.member-stays" MemberStays "A printed member of a modal array stays on.",
    "gpp.newline-once" NewlineOnce "The newline procedure runs once in an OUTPUT.",
    "gpp.non-modal-off" NonModalOff "A non-modal variable that is printed goes off.",
    "gpp.off-left-out" OffLeftOut "A modal variable that is off is left out in GPP2.",
    "gpp.presence-stays" PresenceStays "A variable that a block of the toolpath does not include stays on.",
    "gpp.print-keeps" PrintKeeps "PRINT leaves modal variables on.",
    "gpp.tie-toward-zero" TieTowardZero "A tie is rounded toward zero.",
    "inputs.analog-as-bit" AnalogAsBit "M66 stores 1 for every value of an analog input but zero.",
    "inputs.analog-low" AnalogLow "M66 waits for an analog input under L4.",
    "inputs.both-immediate" BothImmediate "M66 takes P and E together where it does not wait.",
    "inputs.fall-as-low" FallAsLow "Waiting for a falling edge is waiting for the low level.",
    "inputs.no-result" NoInputResult "M66 stores its result in no parameter.",
    "inputs.timeout-checked" TimeoutChecked "M66 refuses Q0 although it waits for nothing.",
    "inputs.timeout-zero" TimeoutReadsZero "A wait for an input that timed out reads zero.",
    "inputs.zero-timeout" ZeroTimeout "A wait of zero seconds is accepted.",
    "modal-groups.begins-with-traverse" BeginsWithTraverse "A program begins with another motion mode.",
    "modal-groups.code-cut" GcodeCut "G and M numbers are truncated.",
    "modal-groups.fourth-m-word" FourthMWord "A fourth M word of a line is refused.",
    "modal-groups.g-code-wraps" GcodeWraps "G numbers are kept in sixteen bits.",
    "modal-groups.last-wins" LastWins "Of two codes of a modal group the last one counts.",
    "modal-groups.local-offset-moves" LocalOffsetMoves "G52 and a motion code may share the axis words of a block.",
    "modal-groups.m-code-wraps" McodeWraps "M numbers are kept in sixteen bits.",
    "modal-groups.m-codes-together" MCodesTogether "M codes of one group are accepted in one block.",
    "modal-groups.stays-suspended" StaysSuspended "The motion mode that G10 suspends does not come back.",
    "modal-groups.unused-word" UnusedWord "A word that no code uses is ignored.",
    "modal-groups.words-behind-else" WordsBehindElse "Words after else are ignored.",
    "motion.after-cancel" AfterCancel "Axis words after G80 move as the mode before.",
    "motion.polar-angle-absolute" PolarAngleAbsolute "The angle of an incremental polar move counts from the X axis.",
    "motion.rotary-absolute" RotaryAbsolute "Under G91 words of A, B and C are positions.",
    "motion.traverse-needs-feed" TraverseNeedsFeed "A rapid move needs a feed rate.",
    "nct.block-executed-too" BlockExecutedToo "A block that a modal call takes as arguments is also executed.",
    "nct.cancels-first" CancelsFirst "G67 cancels the modal call that was commanded first.",
    "nct.code-cut" CodeCut "A code is truncated and not rounded.",
    "nct.fifth-level" FifthLevel "There is a fifth macro level.",
    "nct.label-cut" LabelCut "The number after GOTO is truncated and not rounded.",
    "nct.locals-not-restored" LocalsNotRestored "Assignments of a macro stay in its caller's variables.",
    "nct.oldest-first" OldestFirst "Of several modal calls the one that was commanded first is called.",
    "nct.once-more" OnceMore "A call is repeated once too often.",
    "nct.reaches-itself" ReachesItself "The blocks of a macro reach the modal call that has called it.",
    "nct.return-within" ReturnWithin "M99 P searches the program that it ends.",
    "nct.six-brackets" SixBrackets "A sixth bracket is accepted within five.",
    "nct.stale-locals" StaleLocals "A level begins with the values of the last macro there.",
    "nct.sub-has-locals" SubHasLocals "A subprogram has local variables of its own.",
    "nct.vacancy-lost" VacancyLost "Vacant variables are zero after a call.",
    "nct.vacant-is-zero" VacantIsZero "In comparisons vacant is zero.",
    "nct.vacant-word-zero" VacantWordZero "A word with a vacant value is zero.",
    "numbers.eighteen-digits" EighteenDigits "A number of more than seventeen digits is refused.",
    "numbers.m-code-exactly" MCodeExactly "An M code must be an integer exactly.",
    "numbers.point-alone" PointAlone "A point without a digit is zero.",
    "numbers.two-signs" TwoSigns "A number may have two signs.",
    "offsets.active-waits" ActiveWaits "G10 L2 of the active system waits for its selection.",
    "offsets.calculated-without-local" CalculatedWithoutLocal "G10 L20 leaves out the offset of G52 and G92.",
    "offsets.foreign-rotation" ForeignRotation "G10 L20 of another coordinate system uses the rotation in force.",
    "offsets.increments-inactive" IncrementsInactive "Under G91 G10 L2 adds to the origin of an inactive system.",
    "offsets.kind-wraps" OffsetKindWraps "L of G10 is kept in eight bits.",
    "offsets.last-system" LastSystem "G59.3 selects G59.2.",
    "offsets.local-unturned" LocalUnturned "The offset of G52 and G92 applies before the rotation.",
    "offsets.machine-incremental" MachineIncremental "G53 adds its words where the distance is incremental.",
    "offsets.machine-keeps-tool" MachineKeepsTool "A move with G53 ends beyond its words by the tool length offset.",
    "offsets.machine-without-axes" MachineWithoutAxes "G53 is accepted without axis words.",
    "offsets.restored-number" RestoredNumber "G92.3 takes the stored offset in the active unit, not the machine's.",
    "offsets.restored-unflagged" RestoredUnflagged "G92.3 leaves #5210 at zero.",
    "offsets.rotation-reversed" RotationReversed "A work coordinate system is turned the wrong way.",
    "offsets.select-compensated" SelectCompensated
        "A coordinate system can be selected while the cutter is compensated.",
    "offsets.set-clears-local" SetClearsLocal "G10 L2 of the active system clears the offset of G52 and G92 in force.",
    "offsets.set-without-system" SetWithoutSystem "G10 L2 without P sets the active coordinate system.",
    "offsets.system-wraps" OffsetSystemWraps "P of G10 is kept in eight bits.",
    "offsets.unset-cleared" UnsetCleared "G52 sets the offset of A to W to zero where the axis has no word.",
    "offsets.zero-is-first" ZeroIsFirst "P0 of G10 L20 is the first coordinate system and not the active one.",
    "order.by-number" ByNumber "M codes of a block are executed by number.",
    "order.data-before-selection" DataBeforeSelection "G10 comes before the selection of a coordinate system.",
    "order.distance-after-reference" DistanceAfterReference "The distance mode changes after G28, G30, G10 and G92.",
    "order.dwell-late" DwellLate "A dwell comes after the other G codes of its block.",
    "order.feed-after-units" FeedAfterUnits "F is read after the length unit of its block has been set.",
    "order.length-before-units" LengthBeforeUnits "Tool length compensation comes before the length unit.",
    "order.save-after-coolant" SaveAfterCoolant "M70 and M73 save the state after coolant is switched.",
    "orient.angle-within-turn" AngleWithinTurn "The angle of M19 with the offset is reduced to one turn.",
    "orient.full-turn-refused" FullTurnRefused "R360 is refused.",
    "orient.no-offset" NoOrientOffset "The angle of M19 has no offset.",
    "orient.oriented-already" OrientedAlready "M19 does nothing while the spindle is oriented already.",
    "orient.request-stays" OrientRequestStays "A spindle at its angle is still commanded to turn there.",
    "orient.stop-keeps-orientation" StopKeepsOrientation "M5 does not clear M19: the spindle stays oriented.",
    "orient.turns-on" OrientTurnsOn "A spindle that was oriented turns on.",
    "orient.turns-on-without-p" TurnsOnWithoutP "M19 without P goes on in the direction in which the spindle turns.",
    "outputs.analog-at-feed" AnalogAtFeed "An analog output does not change with a rapid move.",
    "outputs.analog-by-digital-count" AnalogByDigitalCount "E of M67 and M68 is checked against the digital outputs.",
    "outputs.analog-waits" AnalogWaits "M68 waits for a motion as M67 does.",
    "outputs.dwell-is-motion" DwellIsMotion "Digital outputs that wait for a motion change at a dwell.",
    "outputs.first-counts" FirstWaitingCounts "Of several settings that wait for a motion the first one counts.",
    "outputs.number-wraps" OutputWraps "The number of an input or output is kept in eight bits.",
    "outputs.on-waits" OnWaits "M64 waits for the next motion.",
    "outputs.one-more" OneOutputMore "There is one output more than the machine has.",
    "outputs.one-waits" OneOutputWaits "An output that waits for motion takes the place of another one that waits.",
    "outputs.probe-switches-nothing" ProbeSwitchesNothing "Outputs that wait for a motion do not change with a probe.",
    "overrides.bare-ignores-spindle" BareIgnoresSpindle "M51 without P ignores the spindle that $ selects.",
    "overrides.default-off" DefaultOff "M50 without P disables.",
    "overrides.disabled-already" DisabledAlready "M49 does nothing where the feed override is disabled already.",
    "overrides.disables-adaptive" DisablesAdaptive "M49 stops the use of adaptive feed too.",
    "overrides.enables-all" EnablesAll "M48 with $ enables the speed override of every spindle.",
    "overrides.speed-always" OverrideAlwaysCounts "A disabled speed override counts.",
    "overrides.speed-untouched" SpeedUntouched "M49 leaves the speed override alone.",
    "overrides.stop-always" StopNeverDisabled "The feed stop stops motion although it is disabled.",
    "overrides.wrong-switch" WrongSwitch "M52 switches the feed stop.",
    "parameters.absent-is-zero" AbsentIsZero "A global parameter that is not there is zero.",
    "parameters.absolute-with-tool" AbsoluteWithTool "The absolute coordinates leave out the tool offset.",
    "parameters.clockwise-inverted" ClockwiseInverted "`_spindle_cw` reports the other direction.",
    "parameters.exists-sees-caller" ExistsSeesCaller "EXISTS within a sub is 1 for a local parameter of the caller.",
    "parameters.index-cut" ParameterCut "The number of a parameter is truncated.",
    "parameters.items-old" ItemsNeverNew "M66 updates no HAL item.",
    "parameters.locals-inherited" LocalsInherited "Local names are seen in the subs that are called.",
    "parameters.main-locals-forgotten" MainLocalsForgotten "Main locals are gone when a program begins again.",
    "parameters.metric-inverted" MetricInverted "`_metric` reports whether the unit is inches.",
    "parameters.number-wraps" ParameterWraps "The number of a parameter is kept in sixteen bits.",
    "parameters.position-diameter" PositionDiameter "_x is a diameter in diameter mode.",
    "parameters.read-only-assigned" ReadOnlyAssigned "A setting of a predefined parameter is accepted, and lost.",
    "parameters.right-to-left" RightToLeft "Settings of a block take effect from right to left.",
    "path-control.no-naive-tolerance" NoNaiveTolerance "G64 P without Q has no naive CAM tolerance.",
    "path-control.tolerance-kept" ToleranceKept "G64 without P keeps the tolerance.",
    "path-control.tolerance-once" ToleranceOnce "A G64 with P under a G64 with P keeps the old tolerances.",
    "path-control.zero-q-is-p" ZeroQIsP "Q0 of G64 counts as no Q, so that the naive CAM tolerance is P.",
    "pause.mode-changes" ModeWhilePaused "A paused program does not keep the controller in auto mode.",
    "pause.no-pallets" NoPallets "M60 exchanges no pallets.",
    "pause.not-optional" NotOptional "M1 stops although the switch is off.",
    "pause.optional-first" OptionalStopFirst "M1 stops before the move of its block.",
    "pause.pallet-stop-optional" PalletStopOptional "M60 pauses only where the optional stop switch is on.",
    "pause.pallets-after" PalletsAfter "M60 exchanges the pallets after its pause.",
    "pause.switch-at-start" SwitchAtStart "M1 goes by the optional stop switch as it was when the program began.",
    "positions.all-axes" AllAxes "Axes without a word go to the predefined position too.",
    "positions.intermediate-absolute" IntermediateAbsolute "The axis words of G28 and G30 are absolute under G91.",
    "positions.one-position" OnePosition "G30 goes where G28 goes.",
    "positions.only-linear" OnlyLinear "G30 without axis words moves X, Y and Z only.",
    "positions.stored-number" StoredNumber "G28.1 stores the position in the active length unit.",
    "positions.stored-without-tool" StoredWithoutTool "G30.1 stores the position without the tool offset.",
    "positions.straight" StraightToPosition "The point on the way to a predefined position is left out.",
    "probe.away-without-feed" AwayWithoutFeed "G38.4 and G38.5 are accepted without a feed rate.",
    "probe.miss-accepted" MissAccepted "A probe without contact is not an error.",
    "probe.miss-keeps-flag" MissKeepsFlag "A probe without an error that finds nothing leaves #5070 at 1.",
    "probe.miss-keeps-point" MissKeepsPoint "Parameters 5061 to 5069 stay as they are when G38.3 or G38.5 fails.",
    "probe.no-result" NoProbeResult "#5070 does not report whether the probe changed.",
    "probe.result-without-local" ProbeWithoutLocal "What a probe found is stored without the offset of G52 and G92.",
    "probe.rotary-refused" RotaryProbeRefused "A probe that moves rotary axes alone counts as one that moves nothing.",
    "probe.toward-only" TowardOnly "G38.4 looks for contact as G38.2 does.",
    "program-end.coolant-on" CoolantOn "Coolant flows on after the program's end.",
    "program-end.dynamic-compensation-stays" DynamicCompensationStays "The program end leaves G41.1 and G42.1 on.",
    "program-end.incremental-stays" IncrementalStays "G91 stays after the program's end.",
    "program-end.motion-stays" MotionStays "M2 leaves the motion mode.",
    "program-end.other-overrides-stay" OtherOverridesStay "A program end enables the speed override of spindle 0 only.",
    "program-end.per-revolution-stays" PerRevolutionStays "The program end leaves G95 in force.",
    "program-end.starts-in-mode" StartsInMode "Cycle start leaves the controller in MDI mode.",
    "program-end.stays-oriented" StaysOriented "A program end does not stop a spindle that M19 holds.",
    "program-end.system-stays" SystemStays "The work coordinate system stays after the program's end.",
    "program-end.uvw-plane-stays" UvwPlaneStays "A program end leaves the planes of G17.1, G18.1 and G19.1 in force.",
    "saved-state.direction-not-restored" DirectionNotRestored "M72 does not reverse a spindle that turns.",
    "saved-state.end-restores" EndRestores "The end of a main program restores what M73 has saved in it.",
    "saved-state.feed-not-restored" FeedNotRestored "The feed is not restored.",
    "saved-state.first-save-counts" FirstSaveCounts "M70 saves nothing where its call level has a saved state already.",
    "saved-state.first-spindle" FirstSpindleRestored "M72 restores spindle 0 only.",
    "saved-state.invalidates-all" InvalidatesAll "M71 in a sub invalidates the states of its callers.",
    "saved-state.no-autorestore" NoAutorestore "M73 saves and does not restore.",
    "saved-state.not-invalidated" NotInvalidated "M71 does nothing.",
    "saved-state.once" RestoredOnce "What M70 saved can be restored once.",
    "saved-state.one-level" OneLevel "A sub's save is its caller's.",
    "saved-state.overrides-not-restored" OverridesNotRestored "M72 leaves the override switches.",
    "saved-state.restores-nothing" RestoresNothing "M72 without a saved state is accepted.",
    "saved-state.return-keeps" ReturnKeeps "A return does not restore what M73 saved, and an endsub does.",
    "saved-state.units-forgotten" UnitsForgotten "Modes are restored before the units are.",
    "spindle.last-left-out" LastSpindleLeftOut "$-1 leaves out the last of several spindles.",
    "spindle.negative-speed" NegativeSpeed "A negative speed is taken.",
    "spindle.no-limit" NoSpindleLimit "D of G96 is ignored.",
    "spindle.on-at-zero" OnAtZero "A spindle at a speed of zero is commanded to turn.",
    "spindle.one-direction" OneDirection "M4 is M3.",
    "spindle.reversal-stops" ReversalStops "M4 stops a spindle that turns clockwise.",
    "spindle.speed-for-all" SpeedForAll "S without $ is for every spindle.",
    "spindle.stop-forgets-speed" StopForgetsSpeed "M5 sets the spindle speed to zero.",
    "spindle.stop-stops-all" StopStopsAll "M5 without $ stops every spindle.",
    "spindle.surface-arc" SurfaceArc "Under G96 G2 and G3 are accepted although the spindle does not turn.",
    "splines.any-plane" AnySplinePlane "A spline works in any plane.",
    "splines.half-offset-in-series" HalfOffsetInSeries "A G5 after the first of a series may have just one of I and J.",
    "splines.opening-point-replaces" OpeningPointReplaces
        "A point in the block of G5.2 replaces the current one as the first control point.",
    "splines.quadratic-only" QuadraticOnly "G5 has a control point too few.",
    "splines.series-survives" SeriesSurvives "A series of G5 goes on after other moves.",
    "splines.weight-counts" WeightCounts "G5.2 with P alone counts as a control point of its own.",
    "splines.zero-offsets" ZeroOffsets "I and J of G5.1 may both be zero.",
    "subroutines.arguments-in-place" ArgumentsInPlace "An argument of a call is set before the next one is evaluated.",
    "subroutines.arguments-kept" ArgumentsKept "Parameters of the caller are those of the sub.",
    "subroutines.arguments-shifted" ArgumentsShifted "Arguments begin at #2.",
    "subroutines.eleven-levels" ElevenLevels "A sub may call eleven levels deep.",
    "subroutines.last-argument-lost" LastArgumentLost "The thirtieth argument of a call is not passed.",
    "subroutines.no-arguments-zeroed" NoArgumentsZeroed "In a sub that is called without arguments #1 to #30 are zero.",
    "subroutines.number-wraps" LabelWraps "The number of a sub is kept in sixteen bits.",
    "subroutines.only-passed-restored" OnlyPassedRestored
        "A return restores only as many of #1 to #30 as the call had arguments.",
    "subroutines.returned-flag-kept" ReturnedFlagKept "A call does not clear whether a value was returned.",
    "subroutines.value-lost" ValueLost "The value of a return is lost.",
    "task.entered-in-auto" EnteredInAuto "A block by hand is executed in auto mode.",
    "text.any-length" AnyLength "A line may be of any length.",
    "text.line-number-point" LineNumberPoint "A line number with a point is refused.",
    "text.nothing-deleted" NothingDeleted "A slash deletes no block.",
    "text.o-words-not-deleted" OWordsNotDeleted "Block delete does not skip a line that is an o-word.",
    "text.percent-goes-on" PercentGoesOn "The second percent line does not end a program.",
    "text.semicolon-within" SemicolonWithin "A semicolon within parentheses begins a comment to the end of the line.",
    "text.slash-behind-blank" SlashBehindBlank "A block delete character after a blank deletes nothing.",
    "text.tab-in-number" TabInNumber "A tab between the digits of a number is refused.",
    "threading.both-is-entry" BothIsEntry "L3 of G76 tapers the entry only.",
    "threading.checks-first" ChecksFirst "A synchronised move needs spindle 0 to turn, whatever $ says.",
    "threading.depth-as-radius" DepthAsRadius "Depths of G76 are radii under G7.",
    "threading.half-taper-refused" HalfTaperRefused "G76 refuses an E of exactly half the drive line.",
    "threading.limit-number" LimitNumber "The velocity limit of G33 and G33.1 is compared without converting the unit.",
    "threading.no-spring-passes" NoSpringPasses "G76 makes no spring passes.",
    "threading.standing-spindle" StandingSpindle "A synchronised move is accepted while the spindle is stopped.",
    "tool.change-stops-flood" ChangeStopsFlood "M6 turns the flood coolant off.",
    "tool.dynamic-clears-others" DynamicClearsOthers "G43.1 removes the offsets of the axes that it does not name.",
    "tool.fixture-keeps-local" FixtureKeepsLocal "G10 L11 measures with the offset of G52 and G92.",
    "tool.length-of-selected" LengthOfSelected "G43 without H takes the tool of T that M6 has not changed to yet.",
    "tool.length-wraps" LengthWraps "H and D are kept in eight bits.",
    "tool.measured-at-once" MeasuredAtOnce "G10 L10 of the tool in the spindle changes the length offset in force.",
    "tool.measured-radius" MeasuredRadius "R of G10 L10 and L11 is stored as the diameter.",
    "tool.number-wraps" ToolWraps "T is kept in eight bits.",
    "tool.offset-unit" OffsetUnit "Offsets of the tool table are taken in the active unit.",
    "tool.orientation-zero-free" OrientationZeroFree "L0 of G41.1 and G42.1 is allowed outside of the XZ plane.",
    "tool.same-tool-turns" SameToolTurns "M6 does not stop the spindle for the tool that is in it.",
    "tool.set-forgets-selection" SetForgetsSelection "M61 forgets the tool that T selected.",
    "tool.set-number-length" SetNumberLength "Under G43 M61 puts the length offset of the tool into force.",
    "tool.set-unknown" SetUnknown "M61 takes any number.",
    "tool.spindle-turns-on" SpindleTurnsOn "The spindle turns on over a tool change.",
    "tool.stays-selected" StaysSelected "A tool stays selected after its change.",
    "tool.unload-cancels-length" UnloadCancelsLength "M6 that leaves the spindle empty cancels the tool length offset.",
    "turning.chamfer-by-leg" ChamferByLeg "C in a profile is the length that is cut from each line.",
    "turning.displacement-from-start" DisplacementFromStart "U and W in a profile count from where the cycle begins.",
    "turning.distance-in-depth" DistanceInDepth "D of G71 and G72 shifts the profile along its depth only.",
    "turning.either-axis-monotonic" EitherAxisMonotonic
        "G71 and G72 accept a profile that is monotonic in one of Z and X.",
    "turning.facing-along-z" FacingAlongZ "G72 cuts its layers along Z.",
    "turning.feed-of-profile" FeedOfProfile "F in a profile sets the feed.",
    "turning.first-type-cuts-pockets" FirstTypeCutsPockets "G71.1 and G72.1 cut pockets.",
    "turning.kept-under-compensation" KeptUnderCompensation
        "G71.1, G71.2, G72.1 and G72.2 are accepted under compensation.",
    "turning.large-fillet-left-out" LargeFilletLeftOut "A fillet of a profile that does not fit is left out.",
    "turning.one-word-moves-both" OneWordMovesBoth
        "The first traverse of a lathe cycle with X alone leads to Z0 too, with Z alone to X0.",
    "turning.pass-counts-whole" PassCountsWhole "The last pass of G70 keeps a share of D.",
    "turning.passes-ascend" PassesAscend "G70 makes the pass next to the profile first.",
    "turning.side-of-greater-x" SideOfGreaterX "A positive distance of G70 is towards greater X wherever the tool is.",
    "turning.straight-to-next-pass" StraightToNextPass
        "Between two passes G70 does not return to where the cycle starts.",
    "turning.traverse-in-profile" TraverseInProfile "G0 in a profile is a traverse of G70.",
    "units-planes.diameter-absolute-only" DiameterAbsoluteOnly "In diameter mode an X word of G91 is not halved.",
    "units-planes.diameter-as-radius" DiameterAsRadius "An X word under G7 is a radius.",
    "units-planes.feed-number" FeedNumber "A change of unit leaves the number of the feed.",
    "units-planes.only-plain-halves" OnlyPlainHalves "Under G7 the X words of G33, G33.1, G38.n and splines are radii.",
    "units-planes.position-kept" PositionKept "A change of unit leaves the numbers of the position.",
    "units-planes.wrong-plane" WrongPlane "G19 selects the plane of G18.",
    "user-codes.gap-closed" GapClosed "Q without P is the first argument of a user-defined code.",
    "user-codes.swapped" SwappedArguments "P and Q of a user-defined code change places.",
    "user-codes.uncompensated" UserCodeUncompensated "M100 to M199 are refused while cutter compensation is on.",
    "user-codes.zero-is-missing" ZeroIsMissing "An argument of zero of a user-defined code counts as missing.",
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
