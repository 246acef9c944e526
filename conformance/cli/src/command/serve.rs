//! `gaugeblock serve`.

use std::fs::File;
use std::io::{BufReader, Error, Read};
use std::net::{TcpListener, TcpStream};
use std::os::fd::AsFd as _;
use std::sync::Arc;
use std::time::Duration;

use clap::Args;
use gaugeblock_adapter::Adapter;
use gaugeblock_adapter::protocol::{self, Caller, Extension, Served, SpinWait};
use gaugeblock_vocabulary::{Language, Scenario};

use super::controller;
use crate::error::CliError;
use crate::streams;
use crate::streams::write_out;

const EXAMPLES: &str = "Examples:
  gaugeblock certify --controller \"exec:gaugeblock serve --controller production\"
      certify through the protocol: the same verdicts as `certify --controller production`
  gaugeblock serve --controller production --tcp 4100
  gaugeblock certify --controller tcp:127.0.0.1:4100
      certify over the network
  echo '{\"id\":1,\"op\":\"hello\",\"protocol\":1,\"referee\":\"me\"}' | gaugeblock serve --controller reference
      print the declaration of the reference model

The server ends at `bye` or at the end of its input; with --tcp it runs until it is stopped.

Exit status: 0 the session ended; 2 wrong call; 3 the controller is missing or the port is taken.";

/// Bytes of a request that are read at once.
const REQUEST: usize = 64 << 10;

/// Rest after a connection that could not be accepted.
const REST: Duration = Duration::from_millis(50);

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// The controller: reference, production, rs274, linuxcnc, exec:COMMAND, tcp:HOST:PORT or offline:DIR
    #[arg(long, short, value_name = "CONTROLLER", default_value = "production", long_help = controller::NAMES)]
    controller: String,
    /// Protocol extensions to offer [default: files,fresh,motion, and `shows` where the observables depend on the
    /// scenario]; files is never offered over TCP
    #[arg(long, value_enum, value_name = "OFFER", value_delimiter = ',')]
    offer: Option<Vec<Extension>>,
    /// Listen at this address instead of standard input, and print it. A port alone means the loopback address; port 0
    /// means any free port. There is no authentication: any client that can connect can run programs
    #[arg(long, value_name = "[HOST:]PORT")]
    tcp: Option<String>,
}

pub(crate) fn serve(arguments: &Arguments) -> Result<u8, CliError> {
    let controller: Arc<dyn Adapter> = Arc::from(controller::controller(&arguments.controller)?);
    let languages = languages(controller.as_ref());
    let usual = || {
        let observables = controller.observables_vary().then_some(Extension::Shows);
        [Extension::Files, Extension::Fresh, Extension::Motion]
            .into_iter()
            .chain(observables)
            .collect()
    };
    let offers = arguments.offer.clone().unwrap_or_else(usual).into_iter().collect();
    let caller = if arguments.tcp.is_some() { Caller::Network } else { Caller::Parent };
    let served = Served { controller, languages, offers, caller };
    if let Some(address) = &arguments.tcp {
        return listen(&served, address);
    }
    let unfinished = |error: Error| CliError::failure(error.to_string(), "its caller went away");
    // The streams themselves: a request is read at once, and an answer written at once.
    let requests = std::io::stdin().as_fd().try_clone_to_owned().map_err(unfinished)?;
    let requests = Requests { stream: File::from(requests), patience: SpinWait::default() };
    let requests = Box::new(BufReader::with_capacity(REQUEST, requests));
    let answers = std::io::stdout().as_fd().try_clone_to_owned().map_err(unfinished)?;
    protocol::serve(&served, requests, &mut File::from(answers)).map_err(unfinished)?;
    Ok(0)
}

/// A stream from which requests are read, one soon after the other.
struct Requests {
    stream: File,
    patience: SpinWait,
}

impl Read for Requests {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        let _is_there = self.patience.poll_briefly(&self.stream);
        self.stream.read(into)
    }
}

/// A session for each connection.
fn listen(served: &Served, address: &str) -> Result<u8, CliError> {
    let refused = |error: Error| {
        CliError::usage(
            format!("--tcp {address}: {error}"),
            "expected a free port such as 4100, or an address of this machine such as 127.0.0.1:4100",
        )
    };
    // Who says no host means this one, and nobody else.
    let host = if address.contains(':') { "" } else { "127.0.0.1:" };
    let address = format!("{host}{address}");
    let listener = TcpListener::bind(&address).map_err(refused)?;
    let own = listener.local_addr().map_err(refused)?;
    write_out(&format!("{own}\n"));
    streams::check_written()?;
    for connection in listener.incoming() {
        // Whose connection is gone by now asks again. Where descriptors run out, sessions must end first.
        let Ok(connection) = connection else {
            std::thread::sleep(REST);
            continue;
        };
        let served = served.clone();
        std::thread::spawn(move || {
            // It ends one session, and nothing else.
            let _ended = session(&served, connection);
        });
    }
    Ok(0)
}

fn session(served: &Served, connection: TcpStream) -> std::io::Result<()> {
    connection.set_nodelay(true)?;
    let requests = Box::new(BufReader::new(connection.try_clone()?));
    let mut answers = std::io::BufWriter::new(&connection);
    let ended = protocol::serve(served, requests, &mut answers);
    drop(answers);
    // Whoever still reads from it is told, too.
    connection.shutdown(std::net::Shutdown::Both)?;
    ended
}

/// The languages that a controller speaks.
fn languages(controller: &dyn Adapter) -> Vec<Language> {
    let speaks = |language: &Language| {
        let mut scenario = Scenario::default();
        scenario.program.language = *language;
        controller.supports(&scenario).is_ok()
    };
    [Language::Rs274, Language::Nct, Language::Gpp].into_iter().filter(speaks).collect()
}
