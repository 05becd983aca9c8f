//! Markdown as the tests read it: blocks of code, pieces of code in a line, links and headings.

use std::path::{Path, PathBuf};

/// A page of the documentation.
pub struct Page {
    /// From the top of the repository.
    pub path: String,
    pub text: String,
}

/// The folder of the package.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All pages for people: those at the top of the repository and those in `docs`.
pub fn pages() -> Vec<Page> {
    let mut paths = Vec::new();
    for folder in ["", "docs"] {
        let entries = std::fs::read_dir(root().join(folder)).expect("the folder can be read");
        let names = entries.map(|entry| entry.expect("the folder can be read").file_name());
        let names =
            names.map(|name| name.to_string_lossy().into_owned()).filter(|name| name.ends_with(".md"));
        paths.extend(names.map(|name| if folder.is_empty() { name } else { format!("{folder}/{name}") }));
    }
    paths.sort();
    paths.iter().map(|path| Page::read(path)).collect()
}

impl Page {
    pub fn read(path: &str) -> Page {
        let text =
            std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"));
        Page { path: path.to_owned(), text }
    }

    /// The blocks of a language, each without its fences.
    pub fn blocks(&self, language: &str) -> impl Iterator<Item = &str> {
        self.all_blocks().filter(move |(name, _)| *name == language).map(|(_, block)| block)
    }

    /// All blocks with their languages, in their order.
    pub fn all_blocks(&self) -> impl Iterator<Item = (&str, &str)> {
        let fenced = self.text.split("```").skip(1).step_by(2);
        fenced.filter_map(|block| block.split_once('\n'))
    }

    /// The text without blocks of code.
    pub fn prose(&self) -> String {
        self.text.split("```").step_by(2).collect()
    }

    /// The pieces of code that stand in lines of text.
    pub fn code(&self) -> impl Iterator<Item = &str> {
        let prose = self.text.split("```").step_by(2);
        prose.flat_map(|prose| prose.split('`').skip(1).step_by(2))
    }

    /// The targets of links and pictures.
    pub fn links(&self) -> Vec<String> {
        let prose = self.prose();
        let inline = prose.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        let named = prose.lines().filter_map(|line| line.strip_prefix('[')?.split_once("]: "));
        inline.chain(named.map(|(_, target)| target.trim())).map(str::to_owned).collect()
    }

    /// What a link may name after a `#`: headings as GitHub writes them.
    pub fn anchors(&self) -> Vec<String> {
        let prose = self.prose();
        let headings = prose.lines().filter(|line| line.starts_with('#'));
        let anchor = |heading: &str| {
            let heading = heading.trim_start_matches('#').trim().to_lowercase().replace(' ', "-");
            heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, '-' | '_')).collect()
        };
        headings.map(anchor).collect()
    }

    /// A link's file, from the top of the repository.
    pub fn target(&self, link: &str) -> PathBuf {
        let folder = Path::new(&self.path).parent().unwrap_or(Path::new(""));
        root().join(folder).join(link)
    }
}
