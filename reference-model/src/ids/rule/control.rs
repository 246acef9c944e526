//! Each rule of `control`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::CONTROL;

    /// Break leaves the loop at once.
    BREAK = "control.break",
    /// A repeat is not a target of break or continue.
    BREAK_IN_REPEAT = "control.break-in-repeat",
    /// A comment may follow an o-word and changes nothing, unless 11.7.3 is read as forbidding it.
    COMMENT_AFTER = "control.comment-after",
    /// Continue goes to the next test of the condition: the loop begins again when it is true and ends when
    /// it is false.
    CONTINUE = "control.continue",
    /// A do loop runs once before its condition is tested, and again while that is true.
    DO_WHILE = "control.do-while",
    /// An if whose label is defined elsewhere is refused.
    DUPLICATE_IF = "control.duplicate-if",
    /// A repeat whose label is defined elsewhere is refused.
    DUPLICATE_REPEAT = "control.duplicate-repeat",
    /// A while whose label is defined elsewhere, other than by its do, is refused.
    DUPLICATE_WHILE = "control.duplicate-while",
    /// The blocks after else are executed when no condition before was true.
    ELSE = "control.else",
    /// When the condition of if is false, the elseif conditions are tried in order and the first true one
    /// counts.
    ELSEIF = "control.elseif",
    /// After a true condition no more conditions of the group are evaluated.
    FIRST_TRUE_ONLY = "control.first-true-only",
    /// The blocks of an if are executed when its condition is true, and skipped when it is false.
    IF = "control.if",
    /// The same number may label a block in each of several subs and in the main program.
    LABELS_IN_SUBS = "control.labels-in-subs",
    /// A loop that has ended or was left works again when it is reached again.
    LOOP_AGAIN = "control.loop-again",
    /// A condition or loop that is skipped must have its end further on in the program.
    MISSING_END = "control.missing-end",
    /// A label may be a name in angle brackets instead of a number.
    NAMED_LABELS = "control.named-labels",
    /// Conditions and loops can be nested, each with its own number.
    NESTING = "control.nesting",
    /// A repeat loop runs the given number of times.
    REPEAT = "control.repeat",
    /// Each invocation of a recursive sub counts its own repeat.
    REPEAT_RECURSION = "control.repeat-recursion",
    /// A break or continue whose label does not point to a matching while or do is refused.
    STRAY_BREAK = "control.stray-break",
    /// A condition is false when it is zero and true for every other number.
    TRUTH = "control.truth",
    /// An else or elseif with an undefined label is refused.
    UNDEFINED_ELSE = "control.undefined-else",
    /// An else, elseif or endif whose label does not point to a matching if is refused.
    UNMATCHED_ENDIF = "control.unmatched-endif",
    /// An endwhile or endrepeat whose label does not refer to a while or repeat of its kind is refused.
    UNMATCHED_ENDWHILE = "control.unmatched-endwhile",
    /// Other words on the line of an o-word are refused; a line number is not a word.
    UNRELATED_WORDS = "control.unrelated-words",
    /// A while loop tests first and runs while its condition is true.
    WHILE = "control.while",
}
