//! The controller's side of the protocol, for a controller of this project.

use std::io::{BufRead, Write};

use gaugeblock_trace::Language;

use super::{Answer, Declaration, Operation, Reply, Request};
use crate::adapters::Adapter;

/// Answers requests until `bye`, or until there are no more.
///
/// # Errors
/// A stream that cannot be read or written.
pub fn serve(
    controller: &dyn Adapter,
    languages: &[Language],
    requests: &mut dyn BufRead,
    answers: &mut dyn Write,
) -> std::io::Result<()> {
    let (mut line, mut written) = (Vec::new(), Vec::new());
    loop {
        line.clear();
        if requests.read_until(b'\n', &mut line)? == 0 {
            return Ok(());
        }
        if line.trim_ascii().is_empty() {
            continue;
        }
        let (answer, last) = answer(controller, languages, &line);
        // In one piece: whoever waits for it is woken once.
        written.clear();
        serde_json::to_writer(&mut written, &answer)?;
        written.push(b'\n');
        answers.write_all(&written)?;
        answers.flush()?;
        if last {
            return Ok(());
        }
    }
}

/// The answer to a line, and whether the session ends with it.
fn answer(controller: &dyn Adapter, languages: &[Language], line: &[u8]) -> (Answer, bool) {
    let Request { id, operation } = match serde_json::from_slice(line) {
        Ok(request) => request,
        Err(error) => {
            let id = id_of(line).unwrap_or_default();
            return (
                Answer { id, reply: Reply::Refused(format!("not understood: {error}")) },
                false,
            );
        }
    };
    let last = operation == Operation::Bye {};
    let reply = match operation {
        Operation::Hello { .. } => {
            let declaration = Declaration::of(controller.capabilities(), languages.to_vec());
            let sessions = controller.best_jobs().and_then(|jobs| u16::try_from(jobs.get()).ok());
            Reply::Hello(Box::new(Declaration { sessions, ..declaration }))
        }
        // Each run begins on a controller as after power-on.
        Operation::Reset {} | Operation::Bye {} => Reply::Done {},
        Operation::Run { scenario } => {
            if let Err(why) = controller.supports(&scenario) {
                Reply::Unsupported(why)
            } else {
                match controller.run(&scenario) {
                    Ok(outcome) => Reply::Outcome(Box::new(outcome)),
                    Err(error) => Reply::Refused(error.to_string()),
                }
            }
        }
    };
    (Answer { id, reply }, last)
}

/// The id of a request that is not understood otherwise.
fn id_of(line: &[u8]) -> Option<u64> {
    #[derive(serde::Deserialize)]
    struct Id {
        id: u64,
    }
    serde_json::from_slice(line).ok().map(|Id { id }| id)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adapters::reference::Reference;

    fn said(requests: &str) -> Vec<serde_json::Value> {
        let mut answers = Vec::new();
        let speaks = [Language::Rs274];
        serve(&Reference::default(), &speaks, &mut requests.as_bytes(), &mut answers).unwrap();
        let lines = String::from_utf8(answers).unwrap();
        lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }

    #[test]
    fn what_is_not_understood_is_refused_and_the_session_goes_on() {
        let answers = said(
            "{\"id\":1,\"op\":\"dance\"}\n\nno json\n{\"id\":3,\"op\":\"reset\",\"later\":1}\n{\"id\":4,\"op\":\"bye\"}\n{\"id\":5,\"op\":\"reset\"}\n",
        );
        assert_eq!(answers.len(), 4, "nothing is answered after bye");
        assert_eq!(answers[0]["id"], 1);
        assert!(answers[0]["refused"].as_str().unwrap().contains("dance"));
        assert_eq!(answers[1]["id"], 0);
        assert_eq!(answers[2], serde_json::json!({"id": 3, "done": {}}));
        assert_eq!(answers[3], serde_json::json!({"id": 4, "done": {}}));
    }

    #[test]
    fn a_run_has_its_outcome() {
        let run =
            "{\"id\":7,\"op\":\"run\",\"scenario\":{\"program\":{\"main\":\"g0 x1\\nm2\\n\"}}}\n";
        let answers = said(run);
        assert_eq!(answers[0]["outcome"]["end"]["end"], "program_end", "{}", answers[0]);
    }
}
