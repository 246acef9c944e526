//! Numbered and named parameters (11.4.3, 11.4.4).

use alloc::vec;
use alloc::vec::Vec;

use gaugeblock_vocabulary::{Machine, Options, Tool};

use super::{Case, Recorder, check, check_all};
use crate::{Interpreter, Limits, Memory, Scratch};

#[test]
fn settings_wait_for_the_whole_line() {
    check_all(&[
        ("#3=15\n#3=6 g0 x#3\nm2\n", "at 2 straight_traverse end=(x15); #3 = 6"),
        ("#3=15 #3=6\nm2\n", "#3 = 6"),
        ("#31=1\n#31=2 #32=#31\nm2\n", "#31 = 2; #32 = 1"),
        ("#<a>=1\n#<a>=2 #32=#<a>\nm2\n", "#<a> = 2; #32 = 1"),
        ("#<a>=1 #32=exists[#<a>]\nm2\n", "#32 = 0"),
        ("#1=2\n##1=5 #1=3\nm2\n", "#2 = 5; #1 = 3"),
        ("#1=2\n#[#1+29]=5\nm2\n", "#31 = 5"),
        ("g40 g1 #3=15 (foo) #4=-7.0 f1\nm2\n", "#3 = 15; #4 = -7"),
    ]);
}

#[test]
fn numbers_of_parameters_have_a_range() {
    check_all(&[
        ("#5602=1\nm2\n", "#5602 = 1"),
        ("#5603=1\nm2\n", "refused at 1 parameter_out_of_range"),
        ("#0=1\nm2\n", "refused at 1 parameter_out_of_range"),
        ("#31=#0\nm2\n", "refused at 1 parameter_out_of_range"),
        ("#31=#5603\nm2\n", "refused at 1 parameter_out_of_range"),
        ("#31=#[-1]\nm2\n", "refused at 1 parameter_out_of_range"),
        ("#1=6000\n#31=##1\nm2\n", "refused at 2 parameter_out_of_range"),
        ("#1.5=1\nm2\n", "refused at 1 parameter_not_integer"),
        ("#31=#[3/2]\nm2\n", "refused at 1 parameter_not_integer"),
        ("#1=1.5\n#31=##1\nm2\n", "refused at 2 parameter_not_integer"),
        ("#[31.00005]=1\nm2\n", "#31 = 1"),
        ("#31.0=2\nm2\n", "#31 = 2"),
        ("#-1=2\nm2\n", "refused at 1"),
        ("#5420=1\nm2\n", "refused at 1 read_only_parameter"),
        ("#5400=1\nm2\n", "refused at 1 read_only_parameter"),
        ("#1=5428\n##1=1\nm2\n", "refused at 2 read_only_parameter"),
    ]);
}

#[test]
fn position_is_reported() {
    check_all(&[
        ("g0 x3 y4\n#31=#5420 #32=#[5420+1] #33=#<_x>\nm2\n", "#31 = 3; #32 = 4; #33 = 3"),
        ("g0 x1\n#31=[#5420+1]\ng0 x#31\n#32=#<_x>\nm2\n", "#32 = 2"),
    ]);
}

#[test]
fn names_are_folded() {
    check_all(&[
        ("#<P a R am>=1\n#31=#<param>\nm2\n", "#31 = 1; #<param> = 1"),
        ("#<_Glob al>=1\n#31=#<_GLOBAL>\nm2\n", "#31 = 1"),
        ("#31=#<nowhere>\nm2\n", "refused at 1 no_such_parameter"),
        ("#31=#<_nowhere>\nm2\n", "refused at 1 no_such_parameter"),
        ("#<>=1\nm2\n", "refused at 1 bad_expression"),
        ("#<a=1\nm2\n", "refused at 1 bad_expression"),
        ("#31=exists[#<a>]\n#<a>=0\n#32=exists[#<a>]\nm2\n", "#31 = 0; #32 = 1"),
        ("#31=exists[#<_bee>]\n#<_bee>=0\n#32=exists[#<_bee>]\nm2\n", "#31 = 0; #32 = 1"),
        ("#31=exists[#<_x>]\nm2\n", "#31 = 1"),
    ]);
}

#[test]
fn predefined_names_are_read_only() {
    check_all(&[
        ("#<_x>=1\nm2\n", "refused at 1 read_only_parameter"),
        ("#<_value>=1\nm2\n", "refused at 1 read_only_parameter"),
        ("#<_line>=1\nm2\n", "refused at 1 read_only_parameter"),
        ("#<_ini[a]b>=1\nm2\n", "refused at 1 read_only_parameter"),
        ("\n#31=#<_line> #32=#<_call_level> #33=#<_value>\nm2\n", "#31 = 2; #32 = 0; #33 = 0"),
        ("o1 sub\n#31=#<_line> #32=#<_call_level>\no1 endsub\no1 call\nm2\n", "#31 = 2; #32 = 1"),
        ("#31=#<_metric>\nm2\n", "accepted"),
        ("#31=#<_hal[motion.x]>\nm2\n", "refused at 1 no_such_parameter"),
        ("#31=exists[#<_hal[motion.x]>]\nm2\n", "#31 = 0"),
    ]);
}

#[test]
fn ini_entries_are_read() {
    let mut machine = Machine::default();
    machine.ini.insert("[SETUP]XPOS".into(), 3.145);
    let case = Case { machine: Some(machine), ..Case::default() };
    case.check(
        "#31=#<_ini[setup]xpos> #32=exists[#<_ini[Setup]XPos>] #33=exists[#<_ini[setup]y>]\nm2\n",
        "#31 = 3.145; #32 = 1; #33 = 0",
    );
    case.check("(debug,%.2f#<_ini[setup]xpos>)\nm2\n", "messages: 3.15");
    case.check("#31=#<_ini[setup]y>\nm2\n", "refused at 1 no_such_parameter");
}

#[test]
fn ini_entries_have_no_case() {
    let mut machine = Machine::default();
    for (entry, value) in [("[A]\u{c9}", 1.0), ("[a]b", 5.0), ("[A]twice", 2.0), ("[a]TWICE", 3.0)]
    {
        machine.ini.insert(entry.into(), value);
    }
    let case = Case { machine: Some(machine), ..Case::default() };
    case.check("#31=#<_ini[a]b> #32=#<_ini[A]B>\nm2\n", "#31 = 5; #32 = 5");
    case.check("#31=#<_ini[a]Twice>\nm2\n", "#31 = 2");
    case.check("#31=#<_ini[a]\u{c9}>\nm2\n", "#31 = 1");
    case.check("#31=#<_ini[a]\u{e9}>\nm2\n", "refused at 1 no_such_parameter");
}

#[test]
fn only_ascii_letters_have_a_case() {
    check("#<A\u{c9}>=1 #<a\u{e9}>=2\n#31=#<a\u{c9}>\nm2\n", "#31 = 1");
    check("#<_\u{c9}>=1 #<_\u{e9}>=2\n#31=#<_\u{c9}>\nm2\n", "#31 = 1");
    let program = "o<\u{c9}> sub\n#31=1\no<\u{c9}> endsub\no<\u{e9}> call\nm2\n";
    check(program, "refused at 4 unknown_sub");
}

#[test]
fn item_name_without_brackets_is_an_ordinary_name() {
    check_all(&[
        ("#<_hal[x>=5\n#31=#<_hal[x>\nm2\n", "#31 = 5"),
        ("#<_ini[x>=5\n#31=#<_INI[X>\nm2\n", "#31 = 5"),
        ("#<_hal[x]>=5\nm2\n", "refused at 1 read_only_parameter"),
        ("#<_hal[x]y>=5\n#31=#<_hal[x]y>\nm2\n", "#31 = 5"),
        ("#<_ini[x]y>=5\nm2\n", "refused at 1 read_only_parameter"),
    ]);
}

#[test]
fn names_are_bounded() {
    let limits = Limits { named_parameters: 2, ..Limits::default() };
    let case = Case { limits, ..Case::default() };
    case.check("#<a>=1 #<_bee>=2\n#<a>=3\nm2\n", "accepted");
    case.check("#<a>=1 #<_bee>=2\n#<c>=3\nm2\n", "beyond");
}

#[test]
fn locals_belong_to_a_level() {
    check("o1 sub\n#<a>=2\no1 endsub\n#<a>=1\no1 call\n#31=#<a>\nm2\n", "#31 = 1");
    check("o1 sub\n#31=#<a>\no1 endsub\n#<a>=1\no1 call\nm2\n", "refused at 2 no_such_parameter");
    check("o1 sub\n#<a>=1\no1 endsub\no1 call\n#31=#<a>\nm2\n", "refused at 5 no_such_parameter");
    check(
        "o1 sub\n#31=exists[#<a>]\n#<a>=1\no1 endsub\no1 call\no1 call\nm2\n",
        "#31 = 0; no #<a>",
    );
    check(
        "o1 sub\n#<n>=#1\no2 if [#1 gt 0]\no1 call [#1-1]\no2 endif\n#<_sum>=[#<_sum>+#<n>]\no1 endsub\n#<_sum>=0\no1 call [4]\nm2\n",
        "#<_sum> = 10",
    );
}

#[test]
fn scratch_memory_carries_no_state() {
    let new = |scratch| {
        let parameters = [(5220, 2.0), (5241, 7.0)].into_iter().collect();
        let machine = Machine { parameters, ..Machine::default() };
        let (options, limits) = (Options::default(), Limits::default());
        Interpreter::with_scratch(machine, options, limits, scratch).expect("a machine")
    };
    let all = |interpreter: &Interpreter| -> Vec<f64> {
        (0..=5602).map(|number| interpreter.parameters.numbered.get(number)).collect()
    };
    let fresh = all(&new(Scratch::default()));
    let mut used = new(Scratch::default());
    let program =
        "o1 sub\n#30=3 #5602=4 #5241=1\no1 endsub\n#1=1 #31=2\no1 call [7]\n#33=5 g9999\n";
    let ran = used.run(&mut Memory::new(program), &mut Recorder::default(), 100);
    assert!(ran.is_err(), "{ran:?}");
    assert_ne!(all(&used), fresh);
    assert_eq!(all(&new(used.into_scratch())), fresh);
}

#[test]
fn scratch_memory_carries_no_options() {
    let (machine, limits) = (Machine::default(), Limits::default());
    let of = |option: &str| -> Options {
        Options([("expressions.true-value".into(), option.into())].into_iter().collect())
    };
    let mut scratch = Scratch::default();
    for (option, truth) in [("minus-one", -1.0), ("one", 1.0), ("minus-one", -1.0)] {
        let mut interpreter =
            Interpreter::with_scratch(machine.clone(), of(option), limits, scratch)
                .expect("a machine");
        assert_eq!(*interpreter.options(), of(option));
        let mut program = Memory::new("#31=[1 eq 1]\nm2\n");
        let ran = interpreter.run(&mut program, &mut Recorder::default(), 100);
        assert!(ran.is_ok(), "{ran:?}");
        assert_eq!(interpreter.parameters().first(), Some(&(31, truth)), "{option}");
        scratch = interpreter.into_scratch();
    }
}

#[test]
fn tools_are_as_the_program_has_changed_them() {
    let (options, limits) = (Options::default(), Limits::default());
    let tools = vec![Tool { number: 3, ..Tool::default() }];
    let machine = Machine { tools, ..Machine::default() };
    let mut interpreter = Interpreter::new(machine, options, limits).expect("a machine");
    let mut program = Memory::new("g10 l1 p3 z5\nm2\n");
    let ran = interpreter.run(&mut program, &mut Recorder::default(), 100);
    assert!(ran.is_ok(), "{ran:?}");
    let tools = interpreter.tools();
    assert_eq!(
        tools.iter().map(|tool| (tool.number, tool.offset.z)).collect::<Vec<_>>(),
        [(3, 5.0)]
    );
}
