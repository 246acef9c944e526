//! Prefetching: a controller begins the next run early, and only the thread that runs it gets the result.

use std::fs::read_to_string;
use std::time::Duration;

use gaugeblock_adapter::exec::{Exec, Limits};
use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_runner::language::check_program;
use gaugeblock_vocabulary::{End, Outcome, Scenario};

use crate::template::{LOOP, changed, file, limits};

/// An adapter that notes in a file when it starts and what it is asked to run, and does this on a program with `x99`.
struct Noting {
    controller: Exec,
    notes: String,
}

impl Noting {
    fn start(name: &str, does: &str, changes: &[(&str, &str)]) -> Self {
        Self::start_within(name, does, changes, limits())
    }

    fn start_within(name: &str, does: &str, changes: &[(&str, &str)], limits: Limits) -> Self {
        let notes = file(&format!("{name}.notes"), "");
        let noting = format!(
            "open({notes:?}, 'a').write('start\\n')\n{LOOP}    main = request.get('scenario', {{}}).get('program', {{}}).get('main', '')
    open({notes:?}, 'a').write(main.partition('\\n')[0] + '\\n' if main else '')
    if 'x99' in main:\n        {does}\n"
        );
        let changes = [&[(LOOP, noting.as_str())], changes].concat();
        let command = changed(&format!("{name}.py"), &changes);
        let controller = Exec::start(&command, limits).expect("it starts");
        Self { controller: controller.check_language_by(check_program), notes }
    }

    fn notes(&self) -> Vec<String> {
        let notes = read_to_string(&self.notes).expect("the notes");
        notes.lines().map(str::to_owned).collect()
    }

    /// Waits until something has begun, without asking for it.
    fn has_begun(&self, program: &str) {
        while !self.notes().iter().any(|line| line == program) {
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

fn scenario(first: &str) -> Scenario {
    Scenario::of(format!("{first}\nm2\n"))
}

/// Where it ended, if it is known to have ended well.
fn place(outcome: Result<Outcome, HarnessError>) -> Result<f64, String> {
    let outcome = outcome.map_err(|error| error.to_string())?;
    assert_eq!(outcome.end, End::ProgramEnd);
    let state = serde_json::to_value(&outcome.steps[0].state).expect("a state");
    Ok(state["position"]["x"].as_f64().unwrap_or_default())
}

#[test]
fn prefetched_run_begins_early_and_runs_once() {
    let it = Noting::start("begins", "pass", &[]);
    for x in 1..4 {
        let next = scenario(&format!("g0 x{x}"));
        it.controller.prefetch(&next);
        it.has_begun(&format!("g0 x{x}"));
        assert_eq!(place(it.controller.run(&next)), Ok(f64::from(x)));
    }
    assert_eq!(it.notes(), ["start", "g0 x1", "g0 x2", "g0 x3"]);
}

#[test]
fn prefetched_result_of_another_program_is_discarded() {
    let (told, other) = (scenario("g0 x99"), scenario("g0 x1"));
    let die = "sys.exit(3)";
    let hang = "import time; time.sleep(60)";
    let rave = "print('no', flush=True); continue";
    for (name, does, sessions) in
        [("ends", "pass", 1), ("dies", die, 2), ("hangs", hang, 2), ("raves", rave, 2)]
    {
        let it = Noting::start(&format!("other-{name}"), does, &[]);
        it.controller.prefetch(&told);
        it.has_begun("g0 x99");
        assert_eq!(place(it.controller.run(&other)), Ok(1.0), "{name}");
        let started = it.notes().iter().filter(|line| *line == "start").count();
        assert_eq!(started, sessions, "{name}");
        // It is no session that was spoilt by what ran before it.
        assert_eq!(it.controller.notes(), [""; 0], "{name}");
    }
}

#[test]
fn own_actions_are_reported_to_the_caller() {
    let told = scenario("g0 x99");
    let rave = "print(json.dumps({'id': request['id'], 'outcome': {}}), flush=True); continue";
    for (name, does, why) in [
        ("dies", "sys.exit(3)", "ended without an answer (exit status 3, after the request `run`"),
        ("hangs", "import time; time.sleep(60)", "no end after 1 s"),
        ("raves", rave, "unreadable output (answer to `run`"),
    ] {
        let it = Noting::start(&format!("own-{name}"), does, &[]);
        it.controller.prefetch(&told);
        it.has_begun("g0 x99");
        let said = place(it.controller.run(&told)).expect_err(name);
        assert!(said.starts_with(why), "{name}: {said}");
        assert_eq!(place(it.controller.run(&scenario("g0 x1"))), Ok(1.0), "{name}");
    }
}

/// It has its time from when it is waited for, however long nobody did: a pipe holds less than this answer.
#[test]
fn unread_answer_is_not_late() {
    let tell = "print(json.dumps({'id': request['id'], 'outcome': {'language': 'rs274', 'start': {}, 'steps': [], 'end': {'end': 'fault', 'message': 'x' * 500000}}}), flush=True); continue";
    let it = Noting::start("waits", tell, &[]);
    let told = scenario("g0 x99");
    it.controller.prefetch(&told);
    it.has_begun("g0 x99");
    std::thread::sleep(limits().time * 2);
    let outcome = it.controller.run(&told).expect("an outcome");
    assert!(matches!(outcome.end, End::Fault(_)), "{:?}", outcome.end);
}

/// It is set back while its answer is read: where that is none, nobody waits for what comes of the reset, however
/// long an answer may take.
#[test]
fn failed_session_is_not_waited_for() {
    let rave = "import time; print('{\"id\": 0}', flush=True); time.sleep(4000)";
    let limits = Limits { time: Duration::from_secs(3600), ..limits() };
    let it = Noting::start_within("not-waited-for", rave, &[], limits);
    for is_ahead in [false, true] {
        let told = scenario("g0 x99");
        if is_ahead {
            it.controller.prefetch(&told);
        }
        let said = place(it.controller.run(&told)).expect_err("no outcome");
        assert!(said.starts_with("unreadable output (answer to `run`"), "{said}");
        assert_eq!(place(it.controller.run(&scenario("g0 x1"))), Ok(1.0));
    }
}

/// A machine of which there is one: whatever was begun, there is never a second session beside it.
#[test]
fn a_single_machine_stays_single() {
    let lock = file("single.lock", "");
    let locked = format!(
        "import fcntl\nlock = open({lock:?}, 'w')\nfcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)\nDECLARATION = {{\n    \"sessions\": 1, "
    );
    let it = Noting::start("single", "pass", &[("DECLARATION = {\n", &locked)]);
    let (told, other) = (scenario("g0 x1"), scenario("g0 x2"));
    it.controller.prefetch(&told);
    it.has_begun("g0 x1");
    let anew = it.controller.run_fresh(&other).expect("a session of its own");
    assert_eq!(place(anew), Ok(2.0));
    assert_eq!(place(it.controller.run(&told)), Ok(1.0));
    assert_eq!(it.controller.notes(), [""; 0]);
}

/// Each of several threads gets what it runs itself, and with a plan the same verdicts come of it as ever.
#[test]
fn threads_do_not_get_what_others_began() {
    let it = Noting::start("threads", "pass", &[]);
    std::thread::scope(|scope| {
        for thread in 0..4 {
            let it = &it;
            scope.spawn(move || {
                for turn in 0..5 {
                    let x = thread * 10 + turn;
                    let next = scenario(&format!("g0 x{x}"));
                    if turn != 2 {
                        it.controller.prefetch(&next);
                    }
                    assert_eq!(place(it.controller.run(&next)), Ok(f64::from(x)));
                }
            });
        }
    });
}
