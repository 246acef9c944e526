//! Grids: one program and its assertions for each combination of some lists, each a case of its own.
//!
//! A grid has a template of a case. Its texts name the items of the lists:
//!
//! | in the template | becomes |
//! | --- | --- |
//! | `{exit}` | the name of the item of the list `exit` |
//! | `{item.set}` | the text `set` of the item of the list `item` |
//! | `{item.when?}` | the same, or nothing where the item has no such text |
//! | `{mark restore}`, in the program | nothing; it names its line |
//! | `{line restore}`, in an assertion | the number of that line |

use std::collections::BTreeMap;

use gaugeblock_vocabulary::Axis;

use crate::page::{Case, Grid, GridItem, GridList, GridLists, Setup};

impl Grid {
    /// The cases, in the order of the lists' names and of their items.
    ///
    /// # Errors
    /// A list that does not exist, an item without a name, an exception that leaves out nothing, or a placeholder that
    /// stands for nothing.
    pub fn cases(&self, lists: &GridLists) -> Result<Vec<Case>, String> {
        let each = self.each.iter();
        let lists: Vec<(&str, &[GridItem])> = each
            .map(|(list, items)| Ok((list.as_str(), items_of(list, items, lists)?)))
            .collect::<Result<_, String>>()?;
        let mut combinations = product(&lists);
        let is_left_out = |exception: &BTreeMap<String, String>, places: &Vec<usize>| {
            exception.iter().all(|(list, name)| {
                let mut of_list = lists.iter().zip(places).filter(|((known, _), _)| known == list);
                of_list.any(|((_, items), place)| items[*place].get(NAME) == Some(name))
            })
        };
        for exception in &self.except {
            if !combinations.iter().any(|places| is_left_out(exception, places)) {
                return Err(format!("the exception {exception:?} leaves out nothing"));
            }
        }
        combinations.retain(|it| !self.except.iter().any(|exception| is_left_out(exception, it)));
        if let Some(cases) = self.cover {
            let sizes: Vec<usize> = lists.iter().map(|(_, items)| items.len()).collect();
            combinations = covering(combinations, &sizes, cases.get());
        }
        let items = |places: &Vec<usize>| {
            let places = lists.iter().zip(places);
            places.map(|((list, items), place)| (*list, &items[*place])).collect()
        };
        combinations.iter().map(|places| self.case(&items(places))).collect()
    }

    /// The case of a combination.
    fn case(&self, combination: &Combination<'_>) -> Result<Case, String> {
        let item_text = |key: &str| item_text(combination, key);
        let template = filled(&self.program, &|key| {
            // Marks stay until each text is at its place.
            if key.starts_with(MARK) { Ok(format!("{{{key}}}")) } else { item_text(key) }
        })?;
        let (program, lines) = without_marks(&template);
        let assertions = self.assertions.iter().map(|text| {
            filled(text, &|key| match key.strip_prefix(LINE) {
                Some(mark) => {
                    let line = lines.get(mark).ok_or_else(|| format!("no mark `{mark}`"))?;
                    Ok(line.to_string())
                }
                None => item_text(key),
            })
        });
        Ok(Case {
            name: filled(&self.name, &item_text)?,
            why: filled(&self.why, &item_text)?,
            program,
            assertions: assertions.collect::<Result<_, String>>()?,
            golden: None,
            editions: self.editions.clone(),
            needs: combination
                .values()
                .find_map(|item| item.get(NEEDS))
                .or(self.needs.as_ref())
                .cloned(),
            grid: None,
            beyond: Vec::new(),
            setup: self.setup_of(combination)?,
        })
    }

    /// The setup of a case; an item can name the axes of its machine.
    fn setup_of(&self, combination: &Combination<'_>) -> Result<Setup, String> {
        let mut setup = self.setup.clone();
        if let Some(letters) = combination.values().find_map(|item| item.get(AXES)) {
            let axis = |word: char| {
                let found = Axis::ALL.iter().find(|axis| axis.word().starts_with(word));
                found.copied().ok_or_else(|| format!("unknown axis `{word}` in `{AXES}`"))
            };
            setup.machine.axes = letters.chars().map(axis).collect::<Result<_, _>>()?;
        }
        Ok(setup)
    }
}

/// An item of each list.
type Combination<'a> = BTreeMap<&'a str, &'a GridItem>;

/// All combinations: the place of an item in each list, in the order of the lists and of their items.
fn product(lists: &[(&str, &[GridItem])]) -> Vec<Vec<usize>> {
    let mut combinations = vec![Vec::new()];
    for (_, items) in lists {
        let with_item = |begun: &Vec<usize>, place: usize| [begun.as_slice(), &[place]].concat();
        let longer = combinations
            .iter()
            .flat_map(|begun| (0..items.len()).map(move |place| with_item(begun, place)));
        combinations = longer.collect();
    }
    combinations
}

/// Selects combinations until each item is in `cases` of them, or in all that it has. Each step takes the first
/// combination with the most items that are not in enough cases yet.
fn covering(combinations: Vec<Vec<usize>>, sizes: &[usize], cases: usize) -> Vec<Vec<usize>> {
    let mut times: Vec<Vec<usize>> = sizes.iter().map(|size| vec![0; *size]).collect();
    let (mut left, mut taken) = (combinations, Vec::new());
    loop {
        let missing = |combination: &[usize]| {
            let places = combination.iter().zip(&times);
            places.filter(|(place, times)| times[**place] < cases).count()
        };
        let (mut most, mut first) = (0, 0);
        for (place, combination) in left.iter().enumerate() {
            let missing = missing(combination);
            if missing > most {
                (most, first) = (missing, place);
            }
            if most == sizes.len() {
                break;
            }
        }
        if most == 0 {
            return taken;
        }
        let combination = left.remove(first);
        for (place, times) in combination.iter().zip(&mut times) {
            times[*place] += 1;
        }
        taken.push(combination);
    }
}

/// The text of an item that is its name.
const NAME: &str = "name";

/// Text of an item: the option that its cases need.
const NEEDS: &str = "needs";

/// Text of an item: the axes of the machine of its cases, for example `xyzabcuvw`.
const AXES: &str = "axes";

/// What begins a placeholder that names its line.
const MARK: &str = "mark ";

/// What begins a placeholder for the number of a line.
const LINE: &str = "line ";

/// The items of a list, which each have a name.
fn items_of<'a>(
    list: &str,
    items: &'a GridList,
    lists: &'a GridLists,
) -> Result<&'a [GridItem], String> {
    let items = match items {
        GridList::Items(items) => items,
        GridList::Named(name) => {
            lists.get(name).ok_or_else(|| format!("lists.toml has no list `{name}`"))?
        }
    };
    match items.iter().position(|item| !item.contains_key(NAME)) {
        Some(place) => Err(format!("item {} of the list `{list}` has no name", place + 1)),
        None => Ok(items),
    }
}

/// The text that a placeholder names: `item`, `item.set` or `item.when?`.
fn item_text(combination: &Combination<'_>, key: &str) -> Result<String, String> {
    let (list, text) = key.split_once('.').unwrap_or((key, NAME));
    let item = combination.get(list).ok_or_else(|| format!("`{{{key}}}` names no list"))?;
    let (text, is_optional) = text.strip_suffix('?').map_or((text, false), |text| (text, true));
    match item.get(text) {
        Some(found) if found.replace("{mark ", "").contains('{') => Err(format!(
            "`{text}` of `{}` in the list `{list}` has a placeholder; expected none but marks",
            item[NAME]
        )),
        Some(found) => Ok(found.clone()),
        None if is_optional => Ok(String::new()),
        None => Err(format!("`{}` of the list `{list}` has no `{text}`", item[NAME])),
    }
}

/// A template with a text for each placeholder.
fn filled(template: &str, text: &dyn Fn(&str) -> Result<String, String>) -> Result<String, String> {
    let mut filled = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once('{') {
        let (key, after) =
            after.split_once('}').ok_or_else(|| format!("`{{{after}` is not closed"))?;
        filled.push_str(before);
        filled.push_str(&text(key)?);
        rest = after;
    }
    filled.push_str(rest);
    Ok(filled)
}

/// A program without its marks, and the line of each, from 1.
fn without_marks(template: &str) -> (String, BTreeMap<&str, usize>) {
    let mut lines = BTreeMap::new();
    let mut program = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once('{') {
        let (key, after) = after.split_once('}').unwrap_or((after, ""));
        program.push_str(before);
        let line = program.matches('\n').count() + 1;
        lines.insert(key.strip_prefix(MARK).unwrap_or(key), line);
        rest = after;
    }
    program.push_str(rest);
    (program, lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cases of a grid, each as its name, program and assertions; or why there are none.
    fn cases(text: &str) -> Result<Vec<(String, String, Vec<String>)>, String> {
        let grid: Grid = toml::from_str(text).expect("a grid");
        let item = |name: &str| GridItem::from([(NAME.to_owned(), name.to_owned())]);
        let lists = GridLists::from([("planes".to_owned(), vec![item("g17"), item("g18")])]);
        let cases = grid.cases(&lists)?.into_iter();
        Ok(cases.map(|case| (case.name, case.program, case.assertions)).collect())
    }

    const TWO: &str = r#"
        name = "{item} in {plane}"
        each.plane = "planes"
        each.item = [{ name = "feed", set = "f5", is = "feed_rate = 5" }, { name = "mist", set = "m7\nm8" }]
        except = [{ item = "mist", plane = "g18" }]
        program = "{plane}\n{item.set}\nm72 {mark restore}\nm2"
        assert = ["after {line restore} {item.is?}"]
    "#;

    #[test]
    fn each_combination_is_a_case_but_for_exceptions() {
        let text = |text: &str| text.to_owned();
        let one = |name, program, assertion| (text(name), text(program), vec![text(assertion)]);
        assert_eq!(
            cases(TWO),
            Ok(vec![
                one("feed in g17", "g17\nf5\nm72 \nm2", "after 3 feed_rate = 5"),
                one("feed in g18", "g18\nf5\nm72 \nm2", "after 3 feed_rate = 5"),
                one("mist in g17", "g17\nm7\nm8\nm72 \nm2", "after 4 "),
            ])
        );
    }

    #[test]
    fn cover_takes_as_many_combinations_as_each_item_needs() {
        let names = |cover: usize| {
            let text = format!(
                r#"
                name = "{{item}} in {{plane}}"
                cover = {cover}
                each.plane = "planes"
                each.item = [{{ name = "f5" }}, {{ name = "m7" }}, {{ name = "m8" }}]
                program = ""
                assert = []
                "#
            );
            let cases = cases(&text).expect("cases").into_iter();
            cases.map(|(name, _, _)| name).collect::<Vec<_>>()
        };
        assert_eq!(names(1), ["f5 in g17", "m7 in g18", "m8 in g17"]);
        assert_eq!(names(3).len(), 6);
    }

    #[test]
    fn what_stands_for_nothing_is_an_error() {
        for (from, to, why) in [
            ("{item.is?}", "{item.is}", "`mist` of the list `item` has no `is`"),
            ("{item.is?}", "{motion}", "`{motion}` names no list"),
            ("{line restore}", "{line save}", "no mark `save`"),
            ("\"planes\"", "\"codes\"", "lists.toml has no list `codes`"),
            ("name = \"feed\", ", "", "item 1 of the list `item` has no name"),
            ("plane = \"g18\"", "plane = \"g19\"", "leaves out nothing"),
            (
                "set = \"f5\"",
                "set = \"{item.is}\"",
                "`set` of `feed` in the list `item` has a placeholder",
            ),
            ("{item} in", "{item in", "`{item in {plane}` names no list"),
        ] {
            let error = cases(&TWO.replace(from, to)).expect_err(from);
            assert!(error.contains(why), "{error}");
        }
    }
}
