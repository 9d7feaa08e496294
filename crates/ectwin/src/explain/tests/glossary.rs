//! Words of the glossary, and commands of datagrams.

use wire::{AlState, Command};

use super::{explained, subjects};
use crate::explain::{Subject, glossary};

#[test]
fn every_word_of_the_glossary_is_explained() {
    for (word, row) in glossary::words() {
        assert!(subjects(word).contains(&Subject::Word(row)), "{word}");
    }
    let watchdog = explained("watchdog");
    assert!(
        watchdog.starts_with("word watchdog (WDT): ends OP when no process data was written in time"),
        "{watchdog}"
    );
    assert_eq!(subjects("sync manager"), subjects("SyncManager"));
    assert!(explained("DC").contains("distributed clocks"), "its letters are digits too");
    assert!(explained("process data").starts_with("word process data: the values"));
}

fn commands() -> impl Iterator<Item = String> {
    Command::ALL.into_iter().map(|command| format!("{command:?}").to_uppercase())
}

#[test]
fn every_command_of_a_datagram_is_explained() {
    for command in commands() {
        assert!(matches!(subjects(&command)[..], [Subject::Word(_)]), "{command}");
    }
}

/// An abbreviation has its full words; abbreviations of states and commands are names.
#[test]
fn every_abbreviation_of_the_glossary_is_known_by_its_words_too() {
    let is_name = |word: &str| {
        AlState::ALL.iter().any(|state| state.to_string() == word)
            || commands().any(|command| command == word)
    };
    let is_abbreviation =
        |word: &str| word.len() <= 4 && word.chars().filter(char::is_ascii_uppercase).count() >= 2;
    for (word, row) in glossary::words() {
        let words = glossary::words().filter(|(_, other)| *other == row).count();
        assert!(!is_abbreviation(word) || is_name(word) || words > 1, "{word}");
    }
    for (abbreviation, words) in
        [("DC", "distributed clocks"), ("WDT", "watchdog"), ("WKC", "working counter")]
    {
        assert!(
            subjects(abbreviation).iter().any(|subject| subjects(words).contains(subject)),
            "{abbreviation}"
        );
    }
}
