//! Active comments (11.4.14 to 11.4.20).

use super::{Case, check, check_all};

#[test]
fn messages_are_reported() {
    check_all(&[
        ("(msg,hello)\nm2\n", "messages: hello"),
        ("( m S g , Hello #1)\nm2\n", "messages:  Hello #1"),
        ("#1=2\n(debug,a #1 b)\nm2\n", "messages: a 2.000000 b"),
        ("(print,x)(log,y)\nm2\n", "messages: none"),
        ("(print,x)\nm2\n", "at 1 message channel=print text=\"x\""),
        ("(foo) (debug,1)\nm2\n", "messages: 1"),
        ("(debug,1) (foo)\nm2\n", "messages: none"),
        ("(debug,1) ; foo\nm2\n", "messages: none"),
        ("g0 x1 ;debug,a;b(c\nm2\n", "messages: a;b(c"),
        ("(msgs,hello)\n(msg hello)\n(message)\nm2\n", "messages: none"),
        ("(debug,)\nm2\n", "count message = 1"),
        ("#5599=0\n(debug,a)\n(msg,b)\n(print,c)\nm2\n", "messages: b | c"),
    ]);
}

#[test]
fn a_message_comes_before_its_words() {
    check(
        "(msg,a) g0 x1\nm2\n",
        "at 1 message channel=display text=\"a\"; at 1 straight_traverse end=(x1)",
    );
    check(
        "o1 repeat [2]\n(debug,#31) #31=[#31+1]\no1 endrepeat\nm2\n",
        "messages: 1.000000 | 2.000000",
    );
}

#[test]
fn messages_compiled_together_stay_separate() {
    check_all(&[
        (
            "o1 repeat [2]\n(msg,one)\n(msg,two)\n(print,a#31)\n(abort)\n(debug,b)\no1 endrepeat\nm2\n",
            "messages: one | two | a0.000000 | b | one | two | a0.000000 | b",
        ),
        ("o1 sub\n(msg,one)\n(msg,two)\no1 endsub\no1 call\nm2\n", "messages: one | two"),
        ("o1 sub\n(msg,one)\n(abort,two)\no1 endsub\no1 call\nm2\n", "refused at 3; messages: one"),
        (
            "o1 repeat [1]\n(logopen,a)\n(log,b)\n(logopen,c)\no1 endrepeat\nm2\n",
            "at 2 log_open file=\"a\" append=no; at 4 log_open file=\"c\" append=no",
        ),
    ]);
}

#[test]
fn values_are_formatted() {
    check_all(&[
        (
            "#1=0.123456 #2=2.5\n(debug,#1 %d#2 %f#1 %.2f#1 %lf#1)\nm2\n",
            "messages: 0.123456 2 0.1235 0.12 0.123456",
        ),
        ("#1=1.5\n(debug,%.3f a #1 b #1)\nm2\n", "messages:  a 1.500 b 1.500"),
        ("#1=1.5\n(debug,%x #1 100%)\nm2\n", "messages: %x 1.500000 100%"),
        ("#1=1.5\n(debug,%.f#1 %.12f#1)\nm2\n", "messages: %.f1.500000 %.12f1.500000"),
        ("#1=-0.2\n(debug,%d#1)\nm2\n", "messages: 0"),
        ("#<a b>=3\n(debug,%d#<A B> #<_line>)\nm2\n", "messages: 3 2"),
        ("(debug,# #x #[1] ##2)\nm2\n", "messages: # #x #[1] #0.000000"),
        ("(debug,#<a> #<_bee>)\nm2\n", "messages: # #"),
        ("(debug,#6000 #0)\nm2\n", "messages: # #"),
        ("(debug,#<a)\nm2\n", "messages: #<a"),
        ("g0 x2\n(debug,%d#5420 #<_x>)\nm2\n", "messages: 2 2"),
    ]);
    let case = Case {
        options: [("active-comments.absent-name", "six-number-signs")].into(),
        ..Case::default()
    };
    case.check("(debug,#<a>)\nm2\n", "messages: ######");
}

#[test]
fn logs_are_opened_and_closed() {
    check_all(&[
        (
            "(logopen, a.txt )\n(log,x#1)\n(logclose)\n(log,y)\nm2\n",
            "messages: x0.000000; at 1 log_open file=\"a.txt\" append=no; at 3 log_close",
        ),
        ("(logappend,a)\nm2\n", "at 1 log_open file=\"a\" append=yes"),
        ("(log,x)\nm2\n", "messages: none"),
        ("(logclose)\nm2\n", "count log_close = 0"),
        (
            "(probeopen p.txt)\n(probeclose)\nm2\n",
            "at 1 probe_log_open file=\"p.txt\"; at 2 probe_log_close",
        ),
        (
            "(probeclose)\n(probeopen)\nm2\n",
            "count probe_log_close = 0; at 2 probe_log_open file=\"\"",
        ),
    ]);
}

#[test]
fn program_can_abort_itself() {
    check("(abort,enough #1)\nm2\n", "refused at 1 aborted_by_program");
    check("o1 if [0]\n(abort,no)\no1 endif\nm2\n", "accepted");
}

#[test]
fn a_plain_comment_after_an_o_word_changes_nothing() {
    check("o1 if [1] (debug,x) ; y\n#31=1\no1 endif\nm2\n", "#31 = 1; messages: none");
    check("(a) o1 if [1]\n#31=1\no1 endif\nm2\n", "#31 = 1");
    check("o1 if [1] #31=1\no1 endif\nm2\n", "refused at 1 bad_block");
    check("#31=1 o1 if [1]\no1 endif\nm2\n", "refused at 1 bad_block");
}
