//! The printed lines of a manual, from the XML that `pdftohtml -xml -i -stdout` writes: pieces of text
//! with their place in pixels and their font.

use std::collections::BTreeMap;

/// The top of the text of a page; the running header is above it. Pixels from the top.
const HEADER_HEIGHT: i32 = 80;
/// Pieces whose tops differ by less than this are on one line. Pixels.
const SAME_LINE: i32 = 5;
/// A gap of this width is a blank. Pixels.
const BLANK_WIDTH: i32 = 3;
/// A gap of this width parts two cells of a table. Pixels.
const CELL_WIDTH: i32 = 18;
/// Type of programs, of footnotes and, at most, of their marks. Points of the XML's scale.
const PROGRAM_SIZE: i32 = 13;
const FOOTNOTE_SIZE: i32 = 12;
const FOOTNOTE_MARK_SIZE: i32 = 10;

/// The family of a font.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Face {
    /// Running text.
    Serif,
    /// Headings, notes and warnings.
    Sans,
    /// Programs.
    Mono,
}

/// A font of the manual.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Font {
    pub(super) face: Face,
    pub(super) size: i32,
}

/// A piece of text in one font.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) font: Font,
    pub(super) bold: bool,
    pub(super) text: String,
    top: i32,
    left: i32,
    right: i32,
}

/// A printed line; it has at least one piece.
#[derive(Clone, Debug)]
pub(super) struct Line {
    /// Pixels down from the line before it; nothing for the first line of a page.
    pub(super) gap: Option<i32>,
    /// Pixels from the left edge of the page.
    pub(super) left: i32,
    pub(super) pieces: Vec<Piece>,
}

impl Line {
    /// The font of its first piece.
    pub(super) fn font(&self) -> Font {
        self.pieces[0].font
    }

    /// Whether all of it is bold.
    pub(super) fn is_bold(&self) -> bool {
        self.pieces.iter().all(|piece| piece.bold)
    }

    pub(super) fn is_program(&self) -> bool {
        let program = Font { face: Face::Mono, size: PROGRAM_SIZE };
        self.pieces.iter().all(|piece| piece.font == program)
    }

    pub(super) fn is_footnote(&self) -> bool {
        self.font() == Font { face: Face::Serif, size: FOOTNOTE_SIZE }
    }

    /// A heading is bold, sans serif, and begins with its number.
    pub(super) fn is_heading(&self) -> bool {
        let text = self.text();
        let number = text.split(' ').next().unwrap_or_default();
        self.font().face == Face::Sans
            && self.is_bold()
            && number.contains('.')
            && number.chars().all(|mark| mark.is_ascii_digit() || mark == '.')
    }

    /// Its text as running text.
    pub(super) fn text(&self) -> String {
        self.joined(|gap| if gap >= BLANK_WIDTH { " " } else { "" })
    }

    /// Its text as a table row: `|` between two cells.
    pub(super) fn row(&self) -> String {
        self.joined(|gap| match gap {
            CELL_WIDTH.. => " | ",
            BLANK_WIDTH.. => " ",
            _ => "",
        })
    }

    /// Where the cells of a table row begin. Pixels from the left.
    pub(super) fn cell_lefts(&self) -> Vec<i32> {
        let mut lefts = vec![self.left];
        for pair in self.pieces.windows(2) {
            if pair[1].left - pair[0].right >= CELL_WIDTH {
                lefts.push(pair[1].left);
            }
        }
        lefts
    }

    fn joined(&self, between: impl Fn(i32) -> &'static str) -> String {
        let mut text = String::new();
        let mut right = self.left;
        for piece in &self.pieces {
            text.push_str(between(piece.left - right));
            text.push_str(&piece.text);
            right = piece.right;
        }
        text.trim().to_owned()
    }
}

/// All printed lines of the XML, running headers left out.
pub(super) fn lines(xml: &str) -> Vec<Line> {
    let mut fonts = BTreeMap::new();
    let mut lines = Vec::new();
    for page in xml.split("<page ").skip(1) {
        let mut pieces = Vec::new();
        for element in page.split('<').filter(|element| element.starts_with("fontspec ")) {
            if let Some((id, font)) = font(element) {
                fonts.insert(id, font);
            }
        }
        for element in page.split("<text ").skip(1) {
            pieces.extend(piece(element, &fonts));
        }
        pieces.retain(|piece: &Piece| {
            piece.top >= HEADER_HEIGHT && piece.font.size > FOOTNOTE_MARK_SIZE
        });
        pieces.sort_by_key(|piece| piece.top);
        lines.extend(lines_of_page(pieces));
    }
    lines
}

fn lines_of_page(pieces: Vec<Piece>) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    let mut tops: Vec<i32> = Vec::new();
    for piece in pieces {
        match (lines.last_mut(), tops.last()) {
            (Some(line), Some(top)) if piece.top - top <= SAME_LINE => line.pieces.push(piece),
            (_, above) => {
                let gap = above.map(|above| piece.top - above);
                tops.push(piece.top);
                lines.push(Line { gap, left: piece.left, pieces: vec![piece] });
            }
        }
    }
    for line in &mut lines {
        line.pieces.sort_by_key(|piece| piece.left);
        line.left = line.pieces[0].left;
    }
    lines
}

fn font(element: &str) -> Option<(String, Font)> {
    let family = attribute(element, "family")?;
    let face = if family.contains("Mono") {
        Face::Mono
    } else if family.contains("Sans") {
        Face::Sans
    } else {
        Face::Serif
    };
    Some((attribute(element, "id")?.to_owned(), Font { face, size: number(element, "size")? }))
}

/// The piece that an element `<text …>…</text>` holds; nothing where it holds blanks only.
fn piece(element: &str, fonts: &BTreeMap<String, Font>) -> Option<Piece> {
    let (head, rest) = element.split_once('>')?;
    let (marked, _) = rest.split_once("</text>")?;
    let text = plain(marked);
    let (left, width) = (number(head, "left")?, number(head, "width")?);
    (!text.trim().is_empty()).then_some(Piece {
        font: *fonts.get(attribute(head, "font")?)?,
        bold: marked.contains("<b>"),
        text,
        top: number(head, "top")?,
        left,
        right: left + width,
    })
}

fn attribute<'element>(element: &'element str, name: &str) -> Option<&'element str> {
    let (_, rest) = element.split_once(&format!("{name}=\""))?;
    rest.split_once('"').map(|(value, _)| value)
}

fn number(element: &str, name: &str) -> Option<i32> {
    attribute(element, name)?.parse().ok()
}

/// The text without tags and with its entities resolved.
fn plain(marked: &str) -> String {
    let mut text = String::new();
    let mut inside_tag = false;
    for mark in marked.chars() {
        match mark {
            '<' => inside_tag = true,
            '>' => inside_tag = false,
            _ if inside_tag => {}
            _ => text.push(mark),
        }
    }
    text.replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"")
        .replace("&#39;", "'")
        .replace("&amp;", "&")
}

#[cfg(test)]
mod tests {
    use super::*;

    const XML: &str = r#"<page number="1" height="1262">
<fontspec id="0" size="15" family="AB+DejaVuSerif"/>
<fontspec id="1" size="13" family="AB+DejaVuSansMono"/>
<fontspec id="2" size="10" family="AB+DejaVuSerif"/>
<text top="56" left="85" width="50" height="15" font="0">Running header</text>
<text top="120" left="85" width="50" height="15" font="0">Use</text>
<text top="121" left="140" width="20" height="15" font="0"><i>M3 &lt;P&gt;</i></text>
<text top="118" left="161" width="5" height="9" font="2">1</text>
<text top="120" left="160" width="5" height="15" font="0">.</text>
<text top="138" left="300" width="20" height="15" font="0"><b>Word</b></text>
<text top="138" left="400" width="20" height="15" font="0"><b>Meaning</b></text>
</page>
<page number="2" height="1262">
<text top="120" left="85" width="50" height="13" font="1">G0 X1</text>
</page>
"#;

    #[test]
    fn pieces_join_to_lines() {
        let lines = lines(XML);
        let texts: Vec<String> = lines.iter().map(Line::text).collect();
        assert_eq!(texts, ["Use M3 <P>.", "Word Meaning", "G0 X1"]);
        let gaps: Vec<Option<i32>> = lines.iter().map(|line| line.gap).collect();
        assert_eq!(gaps, [None, Some(18), None]);
    }

    #[test]
    fn fonts_and_cells_are_distinguished() {
        let lines = lines(XML);
        assert_eq!(lines[1].row(), "Word | Meaning");
        assert_eq!(lines[1].cell_lefts(), [300, 400]);
        assert!(lines[1].is_bold() && !lines[0].is_bold());
        assert_eq!(lines[2].font(), Font { face: Face::Mono, size: 13 });
    }
}
