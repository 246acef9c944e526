//! The digest of an item's words: enough to recognise the text, too little to give it away.

use sha2::{Digest, Sha256};

use super::kind::Kind;

/// How many bytes of the hash a digest keeps; twice as many hexadecimal digits.
const DIGEST_BYTES: usize = 4;

/// The digest of one item: the beginning of the SHA-256 of its words, joined by one blank.
pub fn digest(kind: Kind, text: &str) -> String {
    hex(&Sha256::digest(words(kind, text).join(" "))[..DIGEST_BYTES])
}

/// The SHA-256 of a whole file, in hexadecimal digits.
pub fn file_digest(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// The words of an item in lower case.
///
/// In an example every run of characters between blanks is a word, since each mark counts there.
/// Elsewhere quotes, emphasis and punctuation only separate words, so that they do not depend on
/// the markup of a document.
pub fn words(kind: Kind, text: &str) -> Vec<String> {
    let text = text.to_lowercase();
    match kind {
        Kind::Example => text.split_whitespace().map(str::to_owned).collect(),
        Kind::Sentence | Kind::List | Kind::Row | Kind::Note | Kind::Warning => text
            .split(|mark: char| !belongs_to_word(mark))
            .map(without_punctuation)
            .filter(|word| !word.is_empty())
            .map(str::to_owned)
            .collect(),
    }
}

/// The word without the full stops and hyphens around it; before a digit they are part of a number.
fn without_punctuation(word: &str) -> &str {
    let word = word.trim_end_matches(['.', '-']);
    let bare = word.trim_start_matches(['.', '-']);
    if bare.starts_with(|first: char| first.is_ascii_digit()) { word } else { bare }
}

/// Letters, digits and the signs that distinguish codes and expressions.
fn belongs_to_word(mark: char) -> bool {
    mark.is_alphanumeric() || "#$%&+/<=>[]_.-".contains(mark)
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_and_line_breaks_do_not_count() {
        let plain = digest(Kind::Sentence, "Program M70 to save, not to restore.");
        let marked = digest(Kind::List, "Program `M70` to\n save, *not*  to 'restore'.");
        assert_eq!(plain, marked);
        assert_eq!(plain.len(), 2 * DIGEST_BYTES);
    }

    #[test]
    fn other_words_give_another_digest() {
        let one = digest(Kind::Sentence, "The speed is 1.5 times S.");
        assert_ne!(one, digest(Kind::Sentence, "The speed is 15 times S."));
        assert_ne!(one, digest(Kind::Sentence, "The speed is 1.5 times F."));
        assert_ne!(one, digest(Kind::Sentence, "The speed is -1.5 times S."));
    }

    #[test]
    fn signs_of_codes_belong_to_words() {
        assert_eq!(words(Kind::Row, "#<_x> | $1 - G59.3."), ["#<_x>", "$1", "g59.3"]);
    }

    #[test]
    fn each_mark_of_an_example_counts() {
        assert_eq!(words(Kind::Example, "G1 X1 (go)\n; end"), ["g1", "x1", "(go)", ";", "end"]);
    }

    #[test]
    fn the_hash_of_a_file_is_its_sha_256() {
        let empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert_eq!(file_digest(b""), empty);
    }
}
