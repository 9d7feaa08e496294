//! The sentences that a line in real time takes.

use control::messages::{AboutSentence, SentenceRow};
use scenario::KnownLine;
use scenario::words::{CONDITIONS, CPU, LINE, Sentence, UNIT};

/// All of them, without those of the scripted master of scenarios and without old spellings.
pub(super) fn all() -> Vec<SentenceRow> {
    let orders = rows(UNIT, AboutSentence::Unit)
        .chain(rows(CPU, AboutSentence::Cpu))
        .chain(rows(LINE, AboutSentence::Line));
    let conditions = CONDITIONS.iter().filter(|row| !row.is_old && !KnownLine::is_of_scripted_master(row));
    let conditions: Vec<SentenceRow> = conditions.map(|row| said(row, AboutSentence::Condition)).collect();
    orders.chain(conditions).collect()
}

fn rows<T>(table: &'static [Sentence<T>], about: AboutSentence) -> impl Iterator<Item = SentenceRow> {
    table.iter().filter(|row| !row.is_old).map(move |row| said(row, about))
}

fn said<T>(row: &Sentence<T>, about: AboutSentence) -> SentenceRow {
    let verb = if about == AboutSentence::Condition { "expect" } else { "do" };
    SentenceRow {
        about,
        verb: verb.to_owned(),
        pattern: row.pattern.to_owned(),
        example: row.example.to_owned(),
        meaning: row.meaning.to_owned(),
    }
}
