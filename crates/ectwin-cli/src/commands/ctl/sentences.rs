//! `ctl sentences`: what `do` and `expect` take.

use control::client::Answered;
use control::messages::{SentenceRow, Sentences, Verb};

use super::shown::Shown;
use super::twin;
use crate::cli::CtlArgs;
use crate::failure::Failure;

/// The sentences that have this text in their words, their example or their meaning.
pub(super) fn list(args: &CtlArgs, text: &str) -> Result<Shown, Failure> {
    let Answered::<Sentences> { content: mut sentences, .. } = twin::ask(args, Verb::Sentences)?;
    let wanted = text.to_lowercase();
    let has = |text: &str| text.to_lowercase().contains(&wanted);
    sentences.sentences.retain(|row| has(&row.pattern) || has(&row.example) || has(&row.meaning));
    if sentences.sentences.is_empty() {
        return Err(Failure::Refused {
            message: format!("no sentence has `{text}`"),
            help: "`ectwin ctl sentences` lists all of them".to_owned(),
        });
    }
    let text = for_people(&sentences);
    Shown::of(&sentences, text)
}

fn for_people(sentences: &Sentences) -> String {
    sentences.sentences.iter().map(row).collect()
}

fn row(row: &SentenceRow) -> String {
    let SentenceRow { verb, pattern, example, meaning, .. } = row;
    format!("{verb:<6}  {pattern}\n        such as: {example}\n        {meaning}\n")
}
