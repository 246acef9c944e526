//! The cost of the adapter protocol for a case: production in another process minus production in this process,
//! compared with a bare round trip of lines of the same size through pipes.
//!
//! `cargo bench -p gaugeblock --bench adapter_overhead`
//!
//! Each case is measured in turn; the minimum of all rounds counts. The cost in a campaign is that of a certification
//! with one job: the referee computes the model and the verdict while the controller works. The cost of a run alone is
//! the latency of one outcome for a caller that only waits.
//!
//! The bare round trips follow each other immediately, so that neither side sleeps. The line below the table has the
//! cost of a round trip after each case of a campaign in this process, where both sides may sleep in between.
#![expect(clippy::print_stdout, reason = "a measurement is printed")]

use std::env;
use std::io::{BufRead, BufReader, Error, Read, Result, Write};
use std::num::NonZero;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::Mutex;
use std::time::Duration;

use gaugeblock_adapter::exec::{Exec, Limits};
use gaugeblock_adapter::protocol::{Answer, Operation, Reply, Request, RunModes};
use gaugeblock_adapter::{Adapter, HarnessError};
use gaugeblock_compare::Capabilities;
use gaugeblock_controllers::Production;
use gaugeblock_runner::certify::{Plan, Scope, certify};
use gaugeblock_suite::{Edition, Suite, scenario_of};
use gaugeblock_vocabulary::{Language, Outcome, Scenario};
use mimalloc::MiMalloc;
use serde_json::Value;

/// The allocator of the command, so that the times are those of the command.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// Runs of each case in each of the three ways.
const ROUNDS: u32 = 15;

/// Campaigns in each of the three ways.
const CAMPAIGNS: u32 = 5;

fn main() -> Result<()> {
    if env::args().nth(1).as_deref() == Some("echo") {
        return echo();
    }
    let suite = Suite::read(&gaugeblock_embedded_suite::files().map_err(Error::other)?)
        .map_err(|errors| Error::other(errors.join("\n")))?;
    let edition = suite
        .edition("linuxcnc-2.9")
        .ok_or_else(|| Error::other("the suite has no edition linuxcnc-2.9"))?;
    let production = Production::default();
    let command = format!("{} serve --controller production", env!("CARGO_BIN_EXE_gaugeblock"));
    let external =
        Exec::start(&command, Limits::default()).map_err(|e| Error::other(e.to_string()))?;
    let external = external.assume_options(suite.defaults());

    let options = suite.options(edition);
    let cases = suite.rules.iter().filter(|rule| rule.language == Language::Rs274);
    let cases = cases.flat_map(|rule| &rule.cases);
    let scenarios = cases.map(|case| scenario_of(case, &options, edition));
    let scenarios: Vec<Scenario> = scenarios
        .filter(|scenario| {
            production.supports(scenario).is_ok() && external.supports(scenario).is_ok()
        })
        .collect();
    let mut bare = EchoProcess::start()?;
    let (mut alone, mut bytes) = (MinimumTimes::of(scenarios.len()), Vec::new());
    for (place, scenario) in scenarios.iter().enumerate() {
        let size = sizes(scenario, &production, &suite)?;
        bytes.push(size);
        for _ in 0..ROUNDS {
            alone.within(place, time(|| production.run(scenario).map_err(failed))?);
            alone.external(place, time(|| external.run(scenario).map_err(failed))?);
            alone.bare(place, time(|| bare.round_trip(size))?);
        }
    }
    let each = bytes.iter().map(|(request, answer)| request + answer).sum::<usize>() / bytes.len();
    println!("{} cases, {each} bytes each, out and back; microseconds a case", bytes.len());
    let with_trips = InProcessWithRoundTrip {
        production: Production::default(),
        bare: Mutex::new((bare, 0)),
        bytes,
    };
    let campaign = campaigns(edition, (&production, &external), &with_trips)?;
    println!(
        "                in process  protocol  overhead  bare round trip  overhead / round trip"
    );
    let [alone_within, through, with_trip] = campaign.means();
    print("in a campaign", [alone_within, through, with_trips.mean_of_consecutive_trips()?]);
    print("a run alone", alone.means());
    println!("a bare round trip after each case of a campaign: {:.1}", with_trip - alone_within);

    let jobs = std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
    let plan = Plan { suite: &suite, edition, only: &[], jobs, scope: Scope::Full };
    let within = time(|| Ok(certify(plan, &production, &|| ()).cases.len()))?;
    let outside = time(|| Ok(certify(plan, &external, &|| ()).cases.len()))?;
    println!(
        "the whole suite on {jobs} processors: {:.2} s in process, {:.2} s through the protocol",
        within.as_secs_f64(),
        outside.as_secs_f64()
    );
    Ok(())
}

/// The times of each case in a campaign of one job: in this process, through the protocol, and in this process with a
/// round trip.
fn campaigns(
    edition: &Edition,
    (production, external): (&Production, &Exec),
    with_trips: &InProcessWithRoundTrip,
) -> Result<MinimumTimes> {
    let suite = Suite::read(&gaugeblock_embedded_suite::files().map_err(Error::other)?);
    let mut suite = suite.map_err(|errors| Error::other(errors.join("\n")))?;
    suite.rules.iter_mut().for_each(|rule| rule.motion.clear());
    let plan =
        Plan { suite: &suite, edition, only: &[], jobs: NonZero::<usize>::MIN, scope: Scope::Full };
    let mut minimum = MinimumTimes::of(with_trips.bytes.len());
    for _ in 0..CAMPAIGNS {
        // A case that is not supported is not run: it costs the same both ways.
        for (place, case) in certify(plan, production, &|| ()).cases.iter().enumerate() {
            minimum.within(place, case.cost);
        }
        for (place, case) in certify(plan, external, &|| ()).cases.iter().enumerate() {
            minimum.external(place, case.cost);
        }
        for (place, case) in certify(plan, with_trips, &|| ()).cases.iter().enumerate() {
            minimum.bare(place, case.cost);
        }
    }
    Ok(minimum)
}

/// Production in this process, with a bare round trip after each run. The n-th trip has the size of the n-th case.
#[derive(Debug)]
struct InProcessWithRoundTrip {
    production: Production,
    /// The process at the other end, and the count of trips so far.
    bare: Mutex<(EchoProcess, usize)>,
    /// Bytes of request and answer of each case.
    bytes: Vec<(usize, usize)>,
}

impl InProcessWithRoundTrip {
    fn trip(&self) -> Result<()> {
        let mut bare = self.bare.lock().map_err(|error| Error::other(error.to_string()))?;
        let size = self.bytes[bare.1 % self.bytes.len()];
        bare.1 += 1;
        bare.0.round_trip(size)
    }

    /// The mean time of a round trip when round trips follow each other immediately, microseconds.
    fn mean_of_consecutive_trips(&self) -> Result<f64> {
        let mut minimum = MinimumTimes::of(self.bytes.len());
        for _ in 0..CAMPAIGNS {
            for place in 0..self.bytes.len() {
                minimum.bare(place, time(|| self.trip())?);
            }
        }
        Ok(minimum.means()[2])
    }
}

impl Adapter for InProcessWithRoundTrip {
    fn capabilities(&self) -> &Capabilities {
        self.production.capabilities()
    }

    fn supports(&self, scenario: &Scenario) -> std::result::Result<(), String> {
        self.production.supports(scenario)
    }

    fn run(&self, scenario: &Scenario) -> std::result::Result<Outcome, HarnessError> {
        let outcome = self.production.run(scenario)?;
        self.trip().map_err(|error| HarnessError::NotRun(error.to_string()))?;
        Ok(outcome)
    }
}

/// The minimum times of each case.
#[derive(Debug)]
struct MinimumTimes {
    /// In process, through the protocol, and of a bare round trip.
    modes: [Vec<Duration>; 3],
    cases: usize,
}

impl MinimumTimes {
    fn of(cases: usize) -> Self {
        Self { modes: Default::default(), cases }
    }

    fn within(&mut self, place: usize, time: Duration) {
        self.add(0, place, time);
    }

    fn external(&mut self, place: usize, time: Duration) {
        self.add(1, place, time);
    }

    fn bare(&mut self, place: usize, time: Duration) {
        self.add(2, place, time);
    }

    fn add(&mut self, way: usize, place: usize, time: Duration) {
        let times = &mut self.modes[way];
        times.resize(times.len().max(place + 1), Duration::MAX);
        times[place] = times[place].min(time);
    }

    /// The means over all cases, microseconds.
    fn means(&self) -> [f64; 3] {
        let cases = u32::try_from(self.cases).unwrap_or(u32::MAX);
        self.modes
            .each_ref()
            .map(|times| times.iter().sum::<Duration>().as_secs_f64() * 1e6 / f64::from(cases))
    }
}

/// A line of the table.
fn print(what: &str, [within, external, bare]: [f64; 3]) {
    let overhead = external - within;
    println!(
        "{what:15} {within:10.1} {external:10.1} {overhead:9.1} {bare:16.1} {:22.2}",
        overhead / bare
    );
}

/// The bytes of the requests and of the answers of a run: its own line, and that of the reset before it.
fn sizes(scenario: &Scenario, production: &Production, suite: &Suite) -> Result<(usize, usize)> {
    let defaults = suite.defaults();
    let operation =
        Operation::Run { scenario: Box::new(scenario.clone()), modes: RunModes::default() };
    let mut request = serde_json::to_value(&Request { id: 1, operation })?;
    let default = serde_json::to_value(Scenario::default())?;
    if let Some(sent) = request["scenario"].as_object_mut() {
        if let Some(options) = sent.get_mut("options").and_then(Value::as_object_mut) {
            options.retain(|id, option| defaults.get(id) != option.as_str());
        }
        sent.retain(|name, value| *value != default[name]);
        for part in ["program", "environment"] {
            if let Some(fields) = sent.get_mut(part).and_then(Value::as_object_mut) {
                fields.retain(|name, value| *value != default[part][name] || name == "language");
            }
        }
    }
    let outcome = production.run(scenario).map_err(failed)?;
    let answer = Answer { id: 1, reply: Reply::Outcome(Box::new(outcome)) };
    let (request, answer) = (serde_json::to_vec(&request)?, serde_json::to_vec(&answer)?);
    let (reset, done) = ("{\"id\":1,\"op\":\"reset\"}\n", "{\"id\":1,\"done\":{}}\n");
    Ok((request.len() + 1 + reset.len(), answer.len() + 1 + done.len()))
}

fn failed(error: HarnessError) -> Error {
    Error::other(error.to_string())
}

#[expect(clippy::disallowed_methods, reason = "time is what is measured")]
fn time<T>(work: impl FnOnce() -> Result<T>) -> Result<Duration> {
    let start = std::time::Instant::now();
    std::hint::black_box(work()?);
    Ok(start.elapsed())
}

/// A child process that answers each line with a line of the requested size.
#[derive(Debug)]
struct EchoProcess {
    child: Child,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
    line: Vec<u8>,
}

impl EchoProcess {
    fn start() -> Result<Self> {
        let mut child = Command::new(env::current_exe()?)
            .arg("echo")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()?;
        let lost = || Error::other("expected pipes to the echo process");
        let requests = child.stdin.take().ok_or_else(lost)?;
        let answers = BufReader::with_capacity(64 << 10, child.stdout.take().ok_or_else(lost)?);
        Ok(Self { child, requests, answers, line: Vec::new() })
    }

    /// Sends a line of `sent` bytes, and receives one of `received` bytes.
    fn round_trip(&mut self, (sent, received): (usize, usize)) -> Result<()> {
        self.line.clear();
        write!(self.line, "{received:012}")?;
        self.line.resize(sent.max(14) - 1, b' ');
        self.line.push(b'\n');
        self.requests.write_all(&self.line)?;
        self.line.clear();
        self.answers.read_until(b'\n', &mut self.line)?;
        let found = self.line.len();
        if found == received {
            Ok(())
        } else {
            Err(Error::other(format!("expected an echo of {received} bytes, found {found}")))
        }
    }
}

impl Drop for EchoProcess {
    fn drop(&mut self) {
        let _ended = self.child.kill();
        let _status = self.child.wait();
    }
}

/// The child's side of [`EchoProcess`]: each line begins with the size of the answer, in 12 digits.
fn echo() -> Result<()> {
    let mut requests = BufReader::with_capacity(64 << 10, std::io::stdin().lock());
    let mut answers = std::io::stdout().lock();
    let mut line = Vec::new();
    loop {
        line.clear();
        if requests.by_ref().read_until(b'\n', &mut line)? == 0 {
            return Ok(());
        }
        let size = std::str::from_utf8(&line[..12]).ok().and_then(|size| size.parse().ok());
        let size: usize = size.ok_or_else(|| {
            Error::other("expected the size of the answer in the first 12 bytes of a line")
        })?;
        line.clear();
        line.resize(size - 1, b' ');
        line.push(b'\n');
        answers.write_all(&line)?;
        answers.flush()?;
    }
}
