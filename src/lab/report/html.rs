//! A report as one page that asks no server for anything: plots and style are in it.

use super::document::{ReportBlock, ReportDocument, ReportPlot, ReportTable};
use crate::lab::html::{escaped, filled};

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");

impl ReportDocument {
    /// The whole page.
    pub fn to_html(&self) -> String {
        let mut chapters = Vec::new();
        let body: Vec<String> = self.blocks.iter().map(|block| self::block(block, &mut chapters)).collect();
        let links = chapters.iter().enumerate();
        let links: String =
            links.map(|(place, name)| format!("<li><a href=\"#c{place}\">{name}</a></li>")).collect();
        let parts = [
            ("title", escaped(&self.title)),
            ("style", STYLE.trim().to_owned()),
            ("contents", links),
            ("body", body.join("\n")),
        ];
        filled(PAGE, &parts)
    }
}

fn block(block: &ReportBlock, chapters: &mut Vec<String>) -> String {
    match block {
        ReportBlock::Chapter(text) => {
            let (name, place) = (escaped(text), chapters.len());
            let heading = format!("<h2 id=\"c{place}\">{name}</h2>");
            chapters.push(name);
            heading
        }
        ReportBlock::Heading(text) => format!("<h3>{}</h3>", escaped(text)),
        ReportBlock::Text(text) => format!("<p>{}</p>", escaped(text)),
        ReportBlock::Items(items) => {
            let items: String = items.iter().map(|item| format!("<li>{}</li>", escaped(item))).collect();
            format!("<ul>{items}</ul>")
        }
        ReportBlock::Code(text) => format!("<pre>{}</pre>", escaped(text.trim_end())),
        ReportBlock::Table(table) => self::table(table),
        ReportBlock::Plots(plots) => {
            format!("<div class=\"plots\">{}</div>", plots.iter().map(plot).collect::<String>())
        }
    }
}

fn table(table: &ReportTable) -> String {
    let row = |cells: &[String], tag: &str| {
        let cells = cells.iter().enumerate().map(|(column, cell)| {
            let class = if column < table.words { "" } else { " class=\"number\"" };
            format!("<{tag}{class}>{}</{tag}>", escaped(cell))
        });
        format!("<tr>{}</tr>", cells.collect::<String>())
    };
    let body: String = table.rows.iter().map(|cells| row(cells, "td")).collect();
    let head = row(&table.head, "th");
    format!("<div class=\"wide\"><table><thead>{head}</thead><tbody>{body}</tbody></table></div>")
}

fn plot(plot: &ReportPlot) -> String {
    format!("<figure>{}<figcaption>{}</figcaption></figure>", plot.svg.trim(), escaped(&plot.caption))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chapters_are_listed_and_texts_are_shown_as_they_are() {
        let table = ReportTable { head: vec!["a".into()], rows: vec![vec!["<1>".into()]], words: 0 };
        let blocks = vec![
            ReportBlock::Chapter("A & B".into()),
            ReportBlock::Table(table),
            ReportBlock::Chapter("{{body}}".into()),
        ];
        let page = ReportDocument { title: "T".into(), blocks }.to_html();
        for wanted in [
            "<a href=\"#c0\">A &amp; B</a>",
            "<h2 id=\"c0\">A &amp; B</h2>",
            "<td class=\"number\">&lt;1&gt;</td>",
            "<h2 id=\"c1\">{{body}}</h2>",
        ] {
            assert_eq!(page.matches(wanted).count(), 1, "{wanted} in {page}");
        }
    }

    #[test]
    fn the_page_asks_for_nothing_from_elsewhere() {
        for door in ["http:", "https:", "src=", "href=", "@import", "url(", "script"] {
            assert!(!PAGE.contains(door) && !STYLE.contains(door), "{door}");
        }
    }
}
