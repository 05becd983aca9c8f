//! A report as Markdown. Plots are left out: there is no way to have them in the text that all readers of Markdown show.

use super::document::{ReportBlock, ReportDocument, ReportTable};

impl ReportDocument {
    /// The whole text.
    pub fn to_markdown(&self) -> String {
        let mut parts = vec![format!("# {}", escaped(&self.title))];
        parts.extend(self.blocks.iter().filter_map(block));
        parts.join("\n\n") + "\n"
    }
}

fn block(block: &ReportBlock) -> Option<String> {
    Some(match block {
        ReportBlock::Chapter(text) => format!("## {}", escaped(text)),
        ReportBlock::Heading(text) => format!("### {}", escaped(text)),
        ReportBlock::Text(text) => escaped(text),
        ReportBlock::Items(items) => {
            items.iter().map(|item| format!("- {}", escaped(item))).collect::<Vec<_>>().join("\n")
        }
        ReportBlock::Code(text) => fenced(text),
        ReportBlock::Table(table) => self::table(table),
        ReportBlock::Plots(_) => return None,
    })
}

fn table(table: &ReportTable) -> String {
    let line = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().map(|cell| escaped(cell)).collect();
        format!("| {} |", cells.join(" | "))
    };
    let rules = (0..table.head.len()).map(|column| if column < table.words { "---|" } else { "---:|" });
    let rule = format!("|{}", rules.collect::<String>());
    let rows = table.rows.iter().map(|row| line(row));
    [line(&table.head), rule].into_iter().chain(rows).collect::<Vec<_>>().join("\n")
}

/// Fences longer than any in the text.
fn fenced(text: &str) -> String {
    let mut fence = "```".to_owned();
    while text.contains(&fence) {
        fence.push('`');
    }
    format!("{fence}\n{}\n{fence}", text.trim_end())
}

/// A text that Markdown shows as it is, in one line. An underscore within a word means nothing there.
fn escaped(text: &str) -> String {
    let letters: Vec<char> = text.split_whitespace().collect::<Vec<_>>().join(" ").chars().collect();
    let is_word = |place: Option<usize>| {
        place.and_then(|place| letters.get(place)).is_some_and(|letter| letter.is_alphanumeric())
    };
    let mut whole = String::new();
    for (place, letter) in letters.iter().enumerate() {
        let is_within = is_word(place.checked_sub(1)) && is_word(Some(place + 1));
        match letter {
            '\\' | '`' | '*' | '|' | '<' => whole.extend(['\\', *letter]),
            '_' if !is_within => whole.extend(['\\', '_']),
            '#' | '>' if place == 0 => whole.extend(['\\', *letter]),
            _ => whole.push(*letter),
        }
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_shown_as_they_are() {
        assert_eq!(escaped("a|b <c> *d* `e`"), r"a\|b \<c> \*d\* \`e\`");
        assert_eq!(escaped("role_swap _x_\n y"), r"role_swap \_x\_ y");
        assert_eq!(escaped("# 1 > 0, # 2"), r"\# 1 > 0, # 2");
        assert_eq!(fenced("a ``` b"), "````\na ``` b\n````");
    }

    #[test]
    fn blocks_stand_apart_and_numbers_to_the_right() {
        let table = ReportTable {
            head: vec!["team".into(), "goals".into()],
            rows: vec![vec!["a".into(), "1".into()], vec!["b".into(), "2".into()]],
            words: 1,
        };
        let document = ReportDocument {
            title: "T".into(),
            blocks: vec![
                ReportBlock::Chapter("C".into()),
                ReportBlock::Items(vec!["x".into(), "y".into()]),
                ReportBlock::Plots(Vec::new()),
                ReportBlock::Table(table),
                ReportBlock::Code("touchline\n".into()),
            ],
        };
        let expected = "# T\n\n## C\n\n- x\n- y\n\n| team | goals |\n|---|---:|\n| a | 1 |\n| b | 2 |\n\n\
                        ```\ntouchline\n```\n";
        assert_eq!(document.to_markdown(), expected);
    }
}
