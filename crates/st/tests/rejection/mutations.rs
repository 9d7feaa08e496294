//! The collection of programs with tokens removed, doubled, exchanged or replaced: the compiler and the machine
//! handle every result.

use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use st::NoHost;

/// Words and signs that occur in programs.
const WORDS: [&str; 40] = [
    "IF",
    "THEN",
    "ELSIF",
    "ELSE",
    "END_IF",
    "CASE",
    "OF",
    "END_CASE",
    "FOR",
    "TO",
    "BY",
    "DO",
    "END_FOR",
    "WHILE",
    "REPEAT",
    "UNTIL",
    "VAR",
    "END_VAR",
    "VAR_INPUT",
    "VAR_IN_OUT",
    "CONSTANT",
    "RETAIN",
    "FUNCTION",
    "PROGRAM",
    "STRING",
    "ARRAY",
    "x",
    "a",
    "0",
    "-1",
    "99999999999",
    "1.5",
    "T#1s",
    "'text'",
    ":=",
    "=>",
    "..",
    "(",
    "]",
    ";",
];

/// The programs of the collection, without their first comments.
fn collection() -> Vec<String> {
    let mut sources = Vec::new();
    let mut folders = vec![PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/programs")];
    while let Some(folder) = folders.pop() {
        read(&folder, &mut folders, &mut sources);
    }
    sources.sort();
    sources
}

fn read(folder: &Path, folders: &mut Vec<PathBuf>, sources: &mut Vec<String>) {
    for entry in fs::read_dir(folder).expect("the collection") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            folders.push(path);
        } else if path.extension().is_some_and(|ending| ending == "st") {
            let text = fs::read_to_string(path).expect("a program");
            sources.extend(text.split_once("*)\n").map(|(_, source)| source.to_owned()));
        }
    }
}

/// Words, numbers and signs, approximately.
fn tokens(source: &str) -> Vec<String> {
    let mut tokens = Vec::<String>::new();
    let is_word = |character: char| character.is_alphanumeric() || matches!(character, '_' | '#' | '.');
    for character in source.chars() {
        let goes_on = tokens.last().and_then(|last| last.chars().last()).is_some_and(|last| {
            (is_word(last) && is_word(character))
                || matches!((last, character), (':', '=') | ('=', '>') | ('<', '=' | '>'))
        });
        match tokens.last_mut() {
            Some(last) if goes_on => last.push(character),
            _ => tokens.push(character.to_string()),
        }
    }
    tokens
}

fn mutate(tokens: &mut Vec<String>, (kind, place, other): (u8, usize, usize)) {
    if tokens.is_empty() {
        return;
    }
    let (place, other) = (place % tokens.len(), other);
    match kind {
        0 => {
            tokens.remove(place);
        }
        1 => tokens.insert(place, tokens[place].clone()),
        2 => {
            let with = other % tokens.len();
            tokens.swap(place, with);
        }
        3 => tokens[place] = WORDS[other % WORDS.len()].to_owned(),
        4 => tokens.insert(place, format!(" {} ", WORDS[other % WORDS.len()])),
        5 => tokens.truncate(place),
        _ => tokens[place] = tokens[other % tokens.len()].clone(),
    }
}

/// Compiles a source, and executes scans if it is accepted.
fn stand(source: &str) -> Result<(), TestCaseError> {
    match st::compile(source, &[]) {
        Ok(program) => {
            let mut instance = program.start();
            for scan in 0..3 {
                // A fault is permitted here.
                let _ = instance.scan(scan * 1_000_000, 200, &mut NoHost);
                prop_assert!(instance.used() <= 200);
            }
            instance.restart();
        }
        Err(problems) => {
            for problem in problems.list() {
                prop_assert!(source.get(problem.span.range()).is_some(), "{problem:?} in {source}");
            }
        }
    }
    Ok(())
}

#[test]
fn a_program_that_was_damaged_does_no_harm() {
    let sources = collection();
    let mutations = prop::collection::vec((0..7_u8, any::<usize>(), any::<usize>()), 1..6);
    let config = ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(4000) };
    let result = proptest::test_runner::TestRunner::new(config).run(
        &(prop::sample::select(sources), mutations),
        |(source, mutations)| {
            let mut tokens = tokens(&source);
            mutations.into_iter().for_each(|mutation| mutate(&mut tokens, mutation));
            stand(&tokens.concat())
        },
    );
    result.unwrap_or_else(|error| panic!("{error}"));
}
