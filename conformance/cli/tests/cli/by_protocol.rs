//! Controllers of this project get the same verdicts through the adapter protocol as in this process, over every
//! transport.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};

use crate::command::gaugeblock;

const ALL: &str = "cancel,digest,files,live-operator,motion,state,stream";

/// A controller of this project that listens.
struct Listening {
    child: Child,
    address: String,
}

impl Listening {
    fn new(more: &[&str]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_gaugeblock"))
            .args([&["serve", "--controller", "production", "--tcp", "0"], more].concat())
            .stdout(Stdio::piped())
            .spawn()
            .expect("it starts");
        let mut address = String::new();
        let output = child.stdout.as_mut().expect("its output");
        BufReader::new(output).read_line(&mut address).expect("its address");
        Self { child, address: address.trim().to_owned() }
    }
}

impl Drop for Listening {
    fn drop(&mut self) {
        let _gone = self.child.kill();
        let _status = self.child.wait();
    }
}

/// Rule, case and verdict, out of a report in JSON.
fn verdicts(controller: &str, only: &[&str]) -> Vec<String> {
    let output =
        gaugeblock(&[&["certify", "--controller", controller, "--format", "json"], only].concat());
    let report = String::from_utf8_lossy(&output.stdout);
    let report: serde_json::Value = serde_json::from_str(&report).unwrap_or_else(|error| {
        panic!("{error}: {report}{}", String::from_utf8_lossy(&output.stderr))
    });
    let cases = report["cases"].as_array().expect("cases").iter();
    let told = cases.map(|case| {
        format!("{} {} {} {}", case["rule"], case["case"], case["verdict"], case["why"])
    });
    told.collect()
}

#[test]
fn a_controller_gets_the_same_verdicts_through_the_protocol() {
    let serve =
        |name: &str| format!("exec:{} serve --controller {name}", env!("CARGO_BIN_EXE_gaugeblock"));
    // A part of the cases: each goes through the protocol in the same way.
    for (name, more) in
        [("production", vec!["--shard", "2/24"]), ("reference", vec!["--edition", "gpp2"])]
    {
        let (plain, behind) = (verdicts(name, &more), verdicts(&serve(name), &more));
        assert_eq!(plain.len(), behind.len());
        let other = plain.iter().zip(&behind).find(|(plain, behind)| plain != behind);
        assert_eq!(other, None);
    }
}

#[test]
fn verdicts_do_not_depend_on_transport() {
    let only: Vec<&str> = ["coolant", "trajectory", "subroutines", "abort", "pause", "orient"]
        .iter()
        .flat_map(|chapter| ["--only", chapter])
        .chain(["--shard", "2/4"])
        .collect();
    let plain = verdicts("production", &only);
    assert!(plain.len() > 300, "{}", plain.len());
    let command = env!("CARGO_BIN_EXE_gaugeblock");
    let without_digest = "cancel,files,live-operator,motion,state,stream";
    for offers in [ALL, without_digest, "motion"] {
        let behind = verdicts(
            &format!("exec:{command} serve --controller production --offer {offers}"),
            &only,
        );
        let other = plain.iter().zip(&behind).find(|(plain, behind)| plain != behind);
        assert_eq!((plain.len(), other), (behind.len(), None), "{offers}");
    }
    for offers in [ALL, without_digest] {
        let listening = Listening::new(&["--offer", offers]);
        let behind = verdicts(&format!("tcp:{}", listening.address), &only);
        let other = plain.iter().zip(&behind).find(|(plain, behind)| plain != behind);
        assert_eq!((plain.len(), other), (behind.len(), None), "{offers} over TCP");
    }
}

/// A session that breaks off leaves the others, and the listener.
#[test]
fn a_listener_serves_many_at_once_and_survives_each() {
    let listening = Listening::new(&[]);
    let connect = || TcpStream::connect(&listening.address).expect("it listens");
    let mut idle = connect();
    let mut broken = connect();
    broken.write_all(b"{\"id\":1,\"op\":").expect("it reads");
    drop(broken);
    let mut other = connect();
    other.write_all(b"no json\n{\"id\":2,\"op\":\"bye\"}\n").expect("it reads");
    let mut said = String::new();
    other.read_to_string(&mut said).expect("it ends");
    assert!(said.contains("refused") && said.lines().count() == 1, "{said}");
    // A web page can send this to any address: neither is a file written, nor is what follows obeyed.
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("over-tcp");
    std::fs::create_dir_all(&folder).expect("a folder");
    let hello = format!(
        "{{\"id\":1,\"op\":\"hello\",\"protocol\":1,\"referee\":\"me\",\"folder\":{folder:?}}}\n"
    );
    let mut page = connect();
    let post = format!("POST / HTTP/1.1\r\nContent-Type: text/plain\r\n\r\n{hello}");
    page.write_all(post.as_bytes()).expect("it reads");
    let mut said = String::new();
    let _it_may_be_reset = page.read_to_string(&mut said);
    assert!(!said.contains("hello"), "{said}");
    let mut named = connect();
    named.write_all(hello.as_bytes()).expect("it reads");
    named.write_all(b"{\"id\":2,\"op\":\"bye\"}\n").expect("it reads");
    let mut said = String::new();
    named.read_to_string(&mut said).expect("it ends");
    assert!(said.contains("refused") && said.contains("no folder"), "{said}");
    assert_eq!(std::fs::read_dir(&folder).expect("a folder").count(), 0);
    idle.write_all(b"{\"id\":1,\"op\":\"bye\"}\n").expect("it reads");
    let mut said = String::new();
    idle.read_to_string(&mut said).expect("it ends");
    assert_eq!(said, "{\"id\":1,\"done\":{}}\n");
}
