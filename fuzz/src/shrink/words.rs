//! Fewer and simpler words.

use std::ops::Range;

use super::search::Search;

/// What kind of block a line is: its codes, letters and keywords, without numbers and order.
pub fn shape(line: &str) -> String {
    let of = |part: Range<usize>| {
        let text = line[part].to_ascii_lowercase();
        let first = text.chars().next().unwrap_or_default();
        match first {
            'g' | 'm' => text.replace(' ', ""),
            'o' => text.rsplit([' ', '>', ']']).next().unwrap_or_default().to_owned(),
            '(' => text.split([',', ')']).next().unwrap_or_default().to_owned(),
            _ => first.to_string(),
        }
    };
    let mut words: Vec<String> = parts(line).into_iter().map(of).collect();
    words.sort_unstable();
    words.dedup();
    words.join(" ")
}

/// Lower case, no line end but LF, no comment, no N word, one blank between words.
pub(super) fn tidy(search: &mut Search<'_>, file: Option<&str>) {
    let text = search.text(file);
    search.attempt_text(file, text.replace('\r', ""));
    let text = search.text(file);
    search.attempt_text(file, text.to_ascii_lowercase());
    let text = search.text(file);
    let lines = text.lines().map(|line| {
        let words: Vec<&str> = parts(line).into_iter().map(|part| line[part].trim()).collect();
        words.join(" ") + "\n"
    });
    search.attempt_text(file, lines.collect());
    each_line(search, file, |line| {
        let words: Vec<&str> = parts(line).into_iter().map(|part| line[part].trim()).collect();
        vec![line.to_ascii_lowercase(), words.join(" ")]
    });
}

/// Leaves out words, settings, comments, arguments.
pub(super) fn remove(search: &mut Search<'_>, file: Option<&str>) {
    let mut at = 0;
    loop {
        let text = search.text(file);
        let Some(line) = text.lines().nth(at) else { break };
        let mut place = 0;
        let mut line = line.to_owned();
        loop {
            let parts = parts(&line);
            if parts.len() < 2 || place >= parts.len() {
                break;
            }
            let words = parts.iter().enumerate().filter(|(which, _)| *which != place);
            let fewer: Vec<&str> = words.map(|(_, part)| line[part.clone()].trim()).collect();
            let fewer = fewer.join(" ");
            if search.attempt_text(file, with_line(&search.text(file), at, &fewer)) {
                line = fewer;
            } else {
                place += 1;
            }
        }
        at += 1;
    }
}

/// Brackets become numbers or what they hold, numbers become round.
pub(super) fn simplify(search: &mut Search<'_>, file: Option<&str>) {
    each_line(search, file, |line| {
        let mut simpler = Vec::new();
        for inner in values(line) {
            let (text, before, after) =
                (&line[inner.clone()], &line[..inner.start], &line[inner.end..]);
            for other in replacements(text) {
                simpler.push(format!("{before}{other}{after}"));
            }
        }
        simpler
    });
}

/// Attempts other forms of each line, again and again while one of them is taken.
fn each_line(search: &mut Search<'_>, file: Option<&str>, others: fn(&str) -> Vec<String>) {
    let count = search.text(file).lines().count();
    for at in 0..count {
        for _ in 0..40 {
            let text = search.text(file);
            let Some(line) = text.lines().nth(at) else { break };
            let taken = others(line).into_iter().any(|other| {
                other != line && search.attempt_text(file, with_line(&text, at, &other))
            });
            if !taken {
                break;
            }
        }
    }
}

fn with_line(text: &str, at: usize, line: &str) -> String {
    let lines = text.lines().enumerate();
    lines
        .map(|(place, old)| if place == at { line } else { old })
        .flat_map(|line| [line, "\n"])
        .collect()
}

/// Simpler forms of a value, the simplest first.
fn replacements(value: &str) -> Vec<String> {
    let mut all = vec!["0".to_owned(), "1".to_owned(), "2".to_owned()];
    if let Ok(number) = value.parse::<f64>() {
        if all.iter().any(|simple| simple == value) {
            return all.into_iter().take_while(|simple| simple != value).collect();
        }
        all.extend(
            [number.trunc(), (number / 2.0).trunc(), number.trunc() - 1.0]
                .iter()
                .filter(|n| n.abs() < 1e15)
                .map(f64::to_string),
        );
        all.push(value.trim_start_matches('+').to_owned());
        all.retain(|simple| {
            simple.len() < value.len()
                || simple.parse::<f64>().is_ok_and(|n| n.abs() < number.abs())
        });
        return all;
    }
    // A bracket: its operands alone. A function: its argument.
    if let Some(open) = value.find('[') {
        let inner = &value[open + 1..value.len().saturating_sub(1)];
        let first = value_end(inner, 0);
        let operands = [&inner[..first], inner.rsplit(' ').next().unwrap_or_default()];
        for operand in operands.map(str::trim).iter().filter(|operand| !operand.is_empty()) {
            all.push(format!("[{operand}]"));
            all.push((*operand).to_owned());
        }
        if open > 0 {
            all.push(format!("[{inner}]"));
        }
        all.retain(|simple| simple.len() < value.len());
    }
    all
}

/// The parts of a line: words with their values, settings, o-words with their keyword, arguments, comments.
fn parts(line: &str) -> Vec<Range<usize>> {
    let bytes = line.as_bytes();
    let (mut parts, mut at) = (Vec::new(), 0);
    while at < bytes.len() {
        let first = at;
        at = match bytes[at] {
            b if b.is_ascii_whitespace() => {
                at += 1;
                continue;
            }
            b'(' => line[at..].find(')').map_or(bytes.len(), |end| at + end + 1),
            b';' => bytes.len(),
            b'[' => value_end(line, at),
            b'#' => setting_end(line, at),
            b'o' | b'O' => o_word_end(line, at),
            b if b.is_ascii_alphabetic() || b == b'$' || b == b'@' || b == b'^' => {
                value_end(line, at + 1).max(at + 1)
            }
            _ => at + line[at..].chars().next().map_or(1, char::len_utf8),
        };
        parts.push(first..at);
    }
    parts
}

/// Where a setting of a parameter ends.
fn setting_end(line: &str, at: usize) -> usize {
    let name = value_end(line, at);
    let rest = &line[name..];
    if rest.trim_start().starts_with('=') {
        value_end(line, name + rest.find('=').unwrap_or_default() + 1)
    } else {
        name.max(at + 1)
    }
}

/// Where an o-word ends: letter, label, keyword.
fn o_word_end(line: &str, at: usize) -> usize {
    let label = value_end(line, at + 1).max(at + 1);
    let rest = &line[label..];
    let blanks = rest.len() - rest.trim_start().len();
    let keyword = rest.trim_start().bytes().take_while(u8::is_ascii_alphabetic).count();
    if keyword > 0 { label + blanks + keyword } else { label }
}

/// Where the value that begins here, after blanks, ends: a number, a parameter, a bracket, a function, a name.
fn value_end(line: &str, from: usize) -> usize {
    let bytes = line.as_bytes();
    let byte = |at: usize| bytes.get(at).copied().unwrap_or_default();
    let mut at = from;
    while byte(at) == b' ' || byte(at) == b'\t' {
        at += 1;
    }
    while matches!(byte(at), b'-' | b'+' | b'#') {
        at += 1;
    }
    if byte(at) == b'<' {
        return line[at..].find('>').map_or(line.len(), |end| at + end + 1);
    }
    let letters = bytes.iter().skip(at).take_while(|b| b.is_ascii_alphabetic()).count();
    if letters > 1 && byte(at + letters) == b'[' {
        at += letters;
    }
    if byte(at) == b'[' {
        let end = bracket_end(bytes, at);
        return if byte(end) == b'/' && byte(end + 1) == b'[' {
            bracket_end(bytes, end + 1)
        } else {
            end
        };
    }
    while byte(at).is_ascii_digit() || byte(at) == b'.' {
        at += 1;
    }
    at
}

fn bracket_end(bytes: &[u8], from: usize) -> usize {
    let mut depth = 0;
    for (at, byte) in bytes.iter().enumerate().skip(from) {
        match byte {
            b'[' => depth += 1,
            b']' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at + 1;
        }
    }
    bytes.len()
}

/// Values that could be simpler, outer ones first: brackets with their function, and numbers that are no codes or
/// names.
fn values(line: &str) -> Vec<Range<usize>> {
    let bytes = line.as_bytes();
    let (mut values, mut at, mut is_code) = (Vec::new(), 0, false);
    while at < bytes.len() {
        let byte = bytes[at];
        let letters = bytes.iter().skip(at).take_while(|b| b.is_ascii_alphabetic()).count();
        if byte == b'(' || byte == b';' {
            break;
        }
        if byte == b'<' {
            at = line[at..].find('>').map_or(bytes.len(), |end| at + end + 1);
        } else if byte == b'[' || (letters > 1 && bytes.get(at + letters) == Some(&b'[')) {
            values.push(at..value_end(line, at));
            at += letters + 1;
            is_code = false;
        } else if byte.is_ascii_digit() || byte == b'.' || byte == b'-' || byte == b'+' {
            let end = value_end(line, at).max(at + 1);
            if !is_code && line[at..end].parse::<f64>().is_ok() {
                values.push(at..end);
            }
            at = end;
        } else {
            is_code = matches!(byte.to_ascii_lowercase(), b'g' | b'm' | b'o' | b'#')
                || (is_code && byte == b' ');
            at += line[at..].chars().next().map_or(1, char::len_utf8);
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_line() {
        let line =
            "/n5 G1x1.5 y[2 + #3]z-sin[#<a b>] #<c d> = atan[1]/[2] o<a b> call [1] [2] (so) ; on";
        let parts: Vec<&str> = parts(line).into_iter().map(|part| &line[part]).collect();
        let expected = [
            "/",
            "n5",
            "G1",
            "x1.5",
            "y[2 + #3]",
            "z-sin[#<a b>]",
            "#<c d> = atan[1]/[2]",
            "o<a b> call",
            "[1]",
            "[2]",
            "(so)",
            "; on",
        ];
        assert_eq!(parts, expected);
    }
}
