//! The choices that text, expressions and o-words depend on, taken from the options once.

use gaugeblock_vocabulary::Options;

use crate::error::Error;

macro_rules! dialect {
    ($($(#[$about:meta])* $id:literal $name:ident { $($(#[$what:meta])* $text:literal $variant:ident,)* })*) => {
        $(
            $(#[$about])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub(crate) enum $name { $($(#[$what])* $variant,)* }

            impl $name {
                const ID: &str = $id;
                /// The default option.
                const FIRST: Self = [$(Self::$variant),*][0];

                fn of(option: &str) -> Result<Self, Error> {
                    match option {
                        $($text => Ok(Self::$variant),)*
                        _ => Err(Error::Configuration(concat!("no such option of ", $id))),
                    }
                }
            }
        )*
    };
}

dialect! {
    /// A percent line in a file that does not begin with one.
    "text.percent-alone" PercentAlone {
        /// It is an illegal line.
        "refused" Refused,
        /// It ends the file.
        "ends" Ends,
        /// It means nothing.
        "ignored" Ignored,
    }
    /// Where ROUND goes from halfway.
    "expressions.round-half" RoundHalf {
        /// Away from zero.
        "away" Away,
        /// To the greater integer.
        "up" Up,
        /// To the even integer.
        "even" Even,
    }
    /// Which line numbers there are.
    "text.greatest-line-number" LineNumbers {
        /// All of them, and a second number after a point.
        "none" Any,
        /// To 9,999,999.
        "seven-digits" SevenDigits,
        /// Those of five digits at most, without a point.
        "five-digits" FiveDigits,
    }
    /// The text for a named parameter that does not exist, in a message.
    "active-comments.absent-name" AbsentName {
        /// One sign.
        "number-sign" One,
        /// Six signs.
        "six-number-signs" Six,
    }
    /// Whether several do loops may carry one label.
    "control.do-label" DoLabel {
        /// Each while ends the do before it.
        "each" Each,
        /// No.
        "refused" Refused,
        /// Every while goes back to the first.
        "first" First,
    }
    /// How often a repeat runs whose count is not an integer.
    "control.repeat-fraction" RepeatFraction {
        /// As the nearest integer says, from halfway the larger one.
        "rounded" Rounded,
        /// As the nearest integer says, from halfway the even one.
        "rounded-to-even" RoundedToEven,
        /// As the integer below says.
        "rounded-down" RoundedDown,
        /// As the integer above says.
        "rounded-up" RoundedUp,
        /// It is refused.
        "refused" Refused,
    }
}

macro_rules! choices {
    (
        several { $($(#[$many_about:meta])* $many:ident: $type:ident,)* }
        two { $($(#[$about:meta])* $field:ident $id:literal [$first:literal, $second:literal],)* }
    ) => {
        /// The choices that apply. Every flag is false under the first option of its page.
        #[derive(Clone, Debug)]
        pub(crate) struct Choices {
            $($(#[$many_about])* pub(crate) $many: $type,)*
            $($(#[$about])* pub(crate) $field: bool,)*
            /// Whether quirks of `rs274` are emulated.
            pub(crate) emulates_rs274: bool,
        }

        impl Choices {
            /// Reads the options.
            ///
            /// # Errors
            /// A choice has an option that its page does not name.
            pub(crate) fn of(options: &Options) -> Result<Self, Error> {
                let mut choices = Self {
                    $($field: false,)* $($many: $type::FIRST,)* emulates_rs274: false
                };
                for (id, option) in &options.0 {
                    match id.as_str() {
                        $($id => choices.$field = match option.as_str() {
                            $first => false,
                            $second => true,
                            _ => return Err(Error::Configuration(concat!("no such option of ", $id))),
                        },)*
                        $($type::ID => choices.$many = $type::of(option)?,)*
                        _ => {}
                    }
                }
                Ok(choices)
            }
        }
    };
}

choices! {
    several {
        /// The text for a name that does not exist, in a message.
        absent_name: AbsentName,
        /// Several do loops with one label.
        do_label: DoLabel,
        /// A count that is not an integer.
        repeat_fraction: RepeatFraction,
        /// Which line numbers there are.
        line_numbers: LineNumbers,
        /// Where ROUND goes from halfway.
        round_half: RoundHalf,
        /// A percent line in a file that does not begin with one.
        percent_alone: PercentAlone,
    }
    two {
        /// A value in a message has four decimals.
        default_four "active-comments.default-format" ["six-decimals", "four-decimals"],
        /// Blanks around the name of a log belong to it.
        log_name_whole "active-comments.file-name-blanks" ["left-out", "part-of-it"],
        /// MSG needs no comma.
        message_free "active-comments.msg-without-comma" ["plain", "message"],
        /// %f gives six decimals.
        format_six "active-comments.plain-f-format" ["four-decimals", "six-decimals"],
        /// A message prints values from before its block.
        message_old "active-comments.same-block-setting" ["new", "old"],
        /// No comment on the line of an o-word.
        oword_comment_refused "control.comment-after-o-word" ["ignored", "refused"],
        /// A label of an ended structure still points to it.
        ended_followed "control.ended-label" ["refused", "followed"],
        /// A negative count is refused.
        negative_refused "control.repeat-negative" ["none", "refused"],
        /// A block that was skipped defines no label.
        skipped_free "control.skipped-definition" ["counts", "does-not-count"],
        /// A label may be the number of the sub around it.
        sub_number_free "control.sub-number-as-label" ["refused", "accepted"],
        /// ATAN gives 0 to 360.
        full_turn "expressions.arctangent-range" ["half-turns", "full-turn"],
        /// MOD has the sign of its left side.
        modulus_dividend "expressions.modulus-sign" ["not-negative", "dividend"],
        /// AND, OR and XOR are in the group of plus and minus.
        logic_among_sums "expressions.logical-precedence" ["after-comparisons", "with-addition"],
        /// A zero keeps the sign with which it was found.
        zero_signed "expressions.negative-zero" ["none", "kept"],
        /// GT GE LT LE take close numbers as equal.
        order_tolerant "expressions.order-tolerance" ["exact", "tolerant"],
        /// True is -1.
        true_minus_one "expressions.true-value" ["one", "minus-one"],
        /// A sign belongs to a number only.
        sign_refused "expressions.unary-minus" ["accepted", "refused"],
        /// A numbered subprogram may call itself.
        call_itself "fanuc-subs.call-itself" ["refused", "allowed"],
        /// A numbered subprogram sees its caller's local parameters.
        locals_shared "fanuc-subs.named-locals" ["hidden", "shared"],
        /// M98 leaves the value of an earlier call.
        value_kept "fanuc-subs.value-after-call" ["cleared", "kept"],
        /// A subprogram that is executed no time need not exist.
        uncalled_free "fanuc-subs.zero-count-unknown" ["refused", "accepted"],
        /// The decimals of a G or M number are rounded to hundredths.
        code_hundredths "modal-groups.code-decimals" ["ten-thousandths", "hundredths"],
        /// There are no parameters above 5399.
        parameters_to_5399 "parameters.greatest" ["to-5602", "to-5399"],
        /// A global parameter that was never set is zero.
        absent_zero "parameters.absent-global" ["refused", "zero"],
        /// A function may follow a number sign.
        function_number "parameters.function-number" ["refused", "accepted"],
        /// #5400 to #5428 can be set.
        position_writable "parameters.read-only-numbered" ["refused", "written"],
        /// The settings of a block take effect before its words act.
        settings_first "parameters.setting-time" ["after-words", "before-words"],
        /// A return must carry the number of its sub.
        return_own "subroutines.return-label" ["any", "own"],
        /// A comment may hold a left parenthesis.
        comment_nested "text.comment-nested" ["refused", "plain"],
        /// A comment without its right parenthesis ends with its line.
        comment_to_line_end "text.comment-to-line-end" ["refused", "to-line-end"],
        /// Comments are blanks, also between a letter and its value.
        comments_removed "text.comments-removed" ["refused", "removed"],
        /// The line end is not one of the 256 characters.
        line_end_free "text.line-end-counted" ["counted", "not-counted"],
        /// A file that begins with a percent line needs the second one although it has an M2.
        percent_needed "text.percent-unclosed-ended" ["accepted", "refused"],
    }
}
