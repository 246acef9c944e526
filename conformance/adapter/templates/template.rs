//! An adapter for Gaugeblock, protocol 1, of an interpreter that writes its canonical calls to a file, a call a line.
//! Its one dependency is `serde_json`. `gaugeblock adapter protocol` has the rest.
use serde_json::{Value, json};

/// The file of a program. Run yours here, as by `std::process::Command`. This one knows G0, G21 and M2.
fn canonical_calls(program: &str) -> String {
    let (mut calls, mut at, mut traverse) = (String::new(), [0.0; 3], false);
    let separate = |text: String, letter| text.replace(letter, &format!(" {letter}"));
    let words = ['g', 'm', 'x', 'y', 'z'].into_iter().fold(program.to_lowercase().replace(' ', ""), separate);
    for block in words.lines() {
        let mut moves = false;
        for word in block.split_whitespace() {
            match (word.get(..1).unwrap_or(""), word.get(1..).unwrap_or("").parse::<f64>()) {
                ("g", Ok(0.0)) => traverse = true,
                ("g", Ok(21.0)) | ("m", Ok(2.0)) => {}
                ("x" | "y" | "z", Ok(to)) if traverse => (at[usize::from(word.as_bytes()[0] - b'x')], moves) = (to, true),
                _ => return calls + "ERROR(unknown word)\n",
            }
        }
        calls += &format!("STRAIGHT_TRAVERSE({:.4}, {:.4}, {:.4})\n", at[0], at[1], at[2]).repeat(usize::from(moves));
        if block.contains('m') {
            return calls + "PROGRAM_END()\n";
        }
    }
    calls
}

/// The outcome that the calls of a program describe.
fn outcome(calls: &str) -> Value {
    let (mut events, mut point, mut end) = (Vec::new(), json!({}), json!({"end": "percent_end"}));
    for (name, arguments) in calls.lines().filter_map(|call| call.strip_suffix(')')?.split_once('(')) {
        let numbers: Vec<f64> = arguments.split(", ").filter_map(|number| number.parse().ok()).collect();
        match (name, numbers.as_slice()) {
            ("STRAIGHT_TRAVERSE", [x, y, z]) => {
                point = json!({"x": x, "y": y, "z": z});
                events.push(json!({"do": {"effect": "straight_traverse", "end": point}}));
            }
            ("PROGRAM_END", _) => end = json!({"end": "program_end"}),
            _ => end = json!({"end": "fault", "message": arguments}),
        }
    }
    let step = json!({"block": {"file": "main.ngc", "line": 1}, "events": events, "state": {"language": "rs274", "position": point}});
    json!({"language": "rs274", "start": {}, "steps": [step], "end": end})
}

fn main() {
    let hello = json!({"protocol": 1, "name": "toy in Rust", "version": "0.1", "languages": ["rs274"], "features": [],
        "units": ["mm", "inch"], "resolution": 1e-4, "clock": "virtual", "language": {"g": ["0", "21"], "m": ["2"],
            "axes": "XYZ", "letters": "", "parameters": [], "expressions": false, "o_words": false, "comments": []},
        "observables": {"blocks": false, "fault_blocks": false, "fault_kinds": false, "fields": ["position"], // calls name no block
            "fields_at_effects": [], "effects": ["straight_traverse"], "moves_in_place": true, "pins": [], "final_parameters": false}});
    for request in std::io::stdin().lines().map_while(Result::ok).flat_map(|it| serde_json::from_str::<Value>(&it)) {
        let (answer, value) = match (request["op"].as_str(), request["scenario"]["program"]["main"].as_str()) {
            (Some("hello"), _) => ("hello", hello.clone()),
            (Some("run"), Some(program)) => ("outcome", outcome(&canonical_calls(program))),
            (op, _) => if op == Some("reset") || op == Some("bye") { ("done", json!({})) } else { ("refused", json!("?")) },
        };
        println!("{}", json!({"id": request["id"], answer: value}));
    }
}
