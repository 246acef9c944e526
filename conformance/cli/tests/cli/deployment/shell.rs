//! As much of a shell's grammar as finds the commands in a script.

/// The calls of `gaugeblock` in a script: their words, with `1` for what a variable holds. Arrays are left out.
pub(crate) fn calls(script: &str) -> Vec<Vec<String>> {
    let is_ours = |word: &String| {
        let name = word.rsplit('/').next().unwrap_or_default();
        name == "gaugeblock" || word == "$gaugeblock" || word == "$GAUGEBLOCK"
    };
    let before = ["expect", "if", "then", "else", "do", "!", "time"];
    let mut calls = Vec::new();
    for command in commands(script) {
        let Some(at) = command.iter().position(is_ours) else { continue };
        let leads = |word: &String| {
            let is_number = word.chars().all(|c| c.is_ascii_digit());
            before.contains(&word.as_str()) || is_number || word.contains('=')
        };
        let words: Vec<_> = command[at + 1..]
            .iter()
            .filter(|word| !is_array(word))
            .map(|word| filled(word))
            .collect();
        if !words.is_empty() && command[..at].iter().all(leads) {
            calls.push(words);
        }
    }
    calls
}

fn is_array(word: &str) -> bool {
    word == "$@" || word.starts_with("${") && word.ends_with("[@]}")
}

/// A word with `1` in the place of each expansion.
fn filled(word: &str) -> String {
    let mut filled = String::new();
    let mut rest = word;
    while let Some((plain, expansion)) = rest.split_once('$') {
        filled.push_str(plain);
        filled.push('1');
        let end = match expansion.chars().next() {
            Some('{') => expansion.find('}').map(|end| end + 1),
            Some('(') => Some(closing(expansion)),
            _ => expansion.find(|c: char| !c.is_ascii_alphanumeric() && c != '_'),
        };
        rest = &expansion[end.unwrap_or(expansion.len())..];
    }
    filled + rest
}

/// Where a parenthesis that opens a text is closed.
fn closing(text: &str) -> usize {
    let mut depth = 0;
    for (at, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at + 1;
        }
    }
    text.len()
}

/// The commands of a script, a list of words each. A redirection is left out.
fn commands(script: &str) -> Vec<Vec<String>> {
    let script = script.replace("\\\n", " ");
    let mut commands = vec![Vec::new()];
    let mut word: Option<String> = None;
    let mut quote = None;
    let mut is_target = false;
    let mut chars = script.char_indices().peekable();
    while let Some((at, c)) = chars.next() {
        match (quote, c) {
            (Some(open), _) if open == c => quote = None,
            (None, '"' | '\'') => {
                quote = Some(c);
                word.get_or_insert_default();
            }
            (Some('"') | None, '\\') => {
                word.get_or_insert_default().extend(chars.next().map(|(_, c)| c));
            }
            (Some('"') | None, '$') if script[at + 1..].starts_with('(') => {
                let end = at + 1 + closing(&script[at + 1..]);
                word.get_or_insert_default().push_str(&script[at..end]);
                while chars.next_if(|(place, _)| *place < end).is_some() {}
            }
            (None, '#') if word.is_none() => while chars.next_if(|(_, c)| *c != '\n').is_some() {},
            (None, ' ' | '\t' | '\n' | ';' | '|' | '&' | '(' | ')' | '<' | '>') => {
                let is_stream = matches!(c, '<' | '>');
                if let Some(whole) = word.take()
                    && !std::mem::take(&mut is_target)
                    && !(is_stream && whole.chars().all(|c| c.is_ascii_digit()))
                    && let Some(command) = commands.last_mut()
                {
                    command.push(whole);
                }
                is_target |= is_stream;
                let joins = c == '&' && script[..at].ends_with('>');
                if matches!(c, '\n' | ';' | '|' | '&' | '(' | ')') && !joins {
                    commands.push(Vec::new());
                }
            }
            _ => word.get_or_insert_default().push(c),
        }
    }
    if let (Some(whole), Some(command)) = (word, commands.last_mut()) {
        command.push(whole);
    }
    commands
}

#[test]
fn calls_are_found_anywhere_in_a_block() {
    for (script, expected) in [
        ("gaugeblock certify --controller rs274", vec!["certify --controller rs274"]),
        ("expect 0 target/release/gaugeblock fuzz --seed 1\n", vec!["fuzz --seed 1"]),
        ("\"$GAUGEBLOCK\" certify \"${more[@]}\" -- \"$C\" || status=$?", vec!["certify -- 1"]),
        (
            "if gaugeblock certify --shard \"$((I + 1))/$N\" > a; then b; fi",
            vec!["certify --shard 1/1"],
        ),
        (
            "gaugeblock certify \\\n  'exec:a b' | grep gaugeblock # gaugeblock c",
            vec!["certify exec:a b"],
        ),
        ("gaugeblock rules 2>&1 >/dev/null && gaugeblock run a", vec!["rules", "run a"]),
        ("docker build --tag gaugeblock .; echo gaugeblock rules", vec![]),
    ] {
        let found: Vec<_> = calls(script).iter().map(|call| call.join(" ")).collect();
        assert_eq!(found, expected, "{script}");
    }
}
