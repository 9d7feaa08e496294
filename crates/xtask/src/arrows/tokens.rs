//! The part of Rust's syntax that paths and imports need.

/// A path as in the source: `crate`, `super`, `self`, modules, items.
pub(super) type Path = Vec<String>;

/// Words and punctuation, without comments, texts, characters and lifetimes.
pub(super) fn of(code: &str) -> Vec<&str> {
    let (mut tokens, mut rest) = (Vec::new(), code);
    while let Some(first) = rest.chars().next() {
        let length = skipped(rest).unwrap_or_else(|| {
            let word = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
            let length = if word > 0 {
                word
            } else if rest.starts_with("::") {
                2
            } else {
                first.len_utf8()
            };
            if !first.is_whitespace() {
                tokens.push(&rest[..length]);
            }
            length
        });
        rest = &rest[length..];
    }
    tokens
}

/// The code with its texts and without its comments.
pub(super) fn without_comments(code: &str) -> String {
    let (mut kept, mut rest) = (String::new(), code);
    while let Some(first) = rest.chars().next() {
        let length = skipped(rest).unwrap_or(first.len_utf8());
        if !rest.starts_with("//") {
            kept.push_str(&rest[..length]);
        }
        rest = &rest[length..];
    }
    kept
}

/// The length of a comment, a text, a character or a lifetime at the beginning.
fn skipped(rest: &str) -> Option<usize> {
    let until =
        |from: usize, end: &str| rest[from..].find(end).map_or(rest.len(), |at| from + at + end.len());
    if rest.starts_with("//") {
        return Some(until(2, "\n"));
    }
    if let Some(raw) = ["r\"", "r#\"", "r##\""].iter().find(|start| rest.starts_with(**start)) {
        return Some(until(raw.len(), &format!("\"{}", "#".repeat(raw.len() - 2))));
    }
    if rest.starts_with('"') {
        return Some(text(rest));
    }
    let mut after = rest.strip_prefix('\'')?.chars();
    Some(match (after.next()?, after.next()) {
        ('\\', _) => until(3, "'"),
        (character, Some('\'')) => 2 + character.len_utf8(),
        _ => 1,
    })
}

/// The length of a text with its quotes.
fn text(rest: &str) -> usize {
    let mut escaped = false;
    for (at, character) in rest.char_indices().skip(1) {
        if character == '"' && !escaped {
            return at + 1;
        }
        escaped = character == '\\' && !escaped;
    }
    rest.len()
}

/// Whether the words before a `use` make it a re-export.
pub(super) fn is_public(before: &[&str]) -> bool {
    let open = before.iter().rposition(|token| *token == "(").unwrap_or_default();
    match before.last() {
        Some(&"pub") => true,
        Some(&")") => open.checked_sub(1).is_some_and(|at| before[at] == "pub"),
        _ => false,
    }
}

/// The path at the beginning; empty if there is none.
pub(super) fn path(tokens: &[&str]) -> Path {
    let mut path = Vec::new();
    for pair in tokens.chunks(2) {
        if !is_word(pair[0]) {
            break;
        }
        path.push(pair[0].to_string());
        if pair.get(1) != Some(&"::") {
            break;
        }
    }
    path
}

fn is_word(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Reads a tree of imports from `at`: names with their paths. Returns its end.
pub(super) fn tree(
    tokens: &[&str],
    mut at: usize,
    front: &[String],
    found: &mut Vec<(String, Path)>,
) -> usize {
    let mut path = front.to_vec();
    while let Some(token) = tokens.get(at) {
        match *token {
            "{" => {
                at += 1;
                while tokens.get(at).is_some_and(|token| *token != "}") {
                    at = tree(tokens, at, &path, found);
                    at += usize::from(tokens.get(at) == Some(&","));
                }
                return at + 1;
            }
            "::" => at += 1,
            "as" => {
                found.push((tokens.get(at + 1).unwrap_or(&"_").to_string(), path));
                return at + 2;
            }
            // A module itself, in a list: `use super::{self, checks}`.
            "self" if !front.is_empty() => at += 1,
            "*" => {
                found.push(("*".to_string(), path));
                return at + 1;
            }
            word if is_word(word) => {
                path.push(word.to_string());
                at += 1;
            }
            _ => break,
        }
    }
    if let Some(name) = path.last() {
        found.push((name.clone(), path.clone()));
    }
    at
}
