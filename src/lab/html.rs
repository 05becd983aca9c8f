//! Pages for browsers: templates with parts to fill, and texts as HTML shows them.

/// A text with `{{name}}` replaced by each part, once, and nothing replaced within parts.
pub(super) fn filled(text: &str, parts: &[(&str, String)]) -> String {
    let mut pieces = text.split("{{");
    let mut whole = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let named = piece.split_once("}}");
        let part =
            named.and_then(|(name, rest)| Some((parts.iter().find(|(known, _)| *known == name)?, rest)));
        match part {
            Some(((_, part), rest)) => whole.extend([part, rest]),
            None => whole.extend(["{{", piece]),
        }
    }
    whole
}

/// A text as HTML shows it.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_stand_at_their_names_and_are_not_filled_themselves() {
        let parts = [("a", "{{b}}".to_owned()), ("b", "x".to_owned())];
        assert_eq!(filled("1 {{a}} 2 {{b}} {{c}}", &parts), "1 {{b}} 2 x {{c}}");
        assert_eq!(escaped("<A & B>"), "&lt;A &amp; B&gt;");
    }
}
