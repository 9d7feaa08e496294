//! What is explained: in every usual notation, and completely.

mod codes;
mod events;
mod glossary;
mod indicators;
mod names;
mod objects;
mod registers;
mod unit_files;

use super::*;

fn subjects(text: &str) -> Vec<Subject> {
    explain(text)
        .unwrap_or_else(|error| panic!("{text}: {error}"))
        .into_iter()
        .map(|known| known.subject)
        .collect()
}

fn explained(text: &str) -> String {
    to_text(&explain(text).unwrap_or_else(|error| panic!("{text}: {error}")))
}

fn refused(text: &str) -> String {
    let unexplained = explain(text).unwrap_err();
    format!("{unexplained}\n{}", unexplained.help())
}
