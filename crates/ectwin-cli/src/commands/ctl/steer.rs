//! `ctl do` and `ctl expect`: sentences one after the other, until the first that is refused or not true.

use std::io;

use control::client::{Answered, Client, ClientError, Nothing};
use control::messages::{Held, Refusal, Verb};
use ectwin::happenings::time_words;
use serde::Serialize;
use time::Duration;

use super::twin;
use crate::cli::CtlArgs;
use crate::failure::Failure;
use crate::failure_document::or_document;
use crate::output::{self, People};

/// The name of stdin among the sentences.
const STDIN: &str = "-";

/// What has become of a sentence.
#[derive(Serialize)]
struct Fate {
    sentence: String,
    #[serde(flatten)]
    result: Outcome,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Outcome {
    Done {
        at_ns: u64,
    },
    Looked {
        at_ns: u64,
        #[serde(flatten)]
        looked: Held,
    },
    Refused {
        error: Refusal,
    },
}

#[derive(Serialize)]
struct Document {
    sentences: Vec<Fate>,
}

/// Carries out orders.
pub(super) fn carry_out(args: &CtlArgs, sentences: &[String]) -> Result<(), Failure> {
    run(args, sentences, |twin, order| {
        let Answered::<Nothing> { at_ns, .. } = twin.ask(Verb::Do(order))?;
        Ok(Outcome::Done { at_ns })
    })
}

/// Checks conditions.
pub(super) fn expect(args: &CtlArgs, sentences: &[String], within: Option<Duration>) -> Result<(), Failure> {
    run(args, sentences, |twin, condition| {
        let Answered { at_ns, content } = twin.ask(Verb::Expect { condition, within })?;
        Ok(Outcome::Looked { at_ns, looked: content })
    })
}

fn run(
    args: &CtlArgs,
    sentences: &[String],
    mut ask: impl FnMut(&mut Client, String) -> Result<Outcome, ClientError>,
) -> Result<(), Failure> {
    let mut client = or_document(args.json, twin::connect(args))?;
    let mut document = Document { sentences: Vec::new() };
    let ended = each(sentences, |sentence| {
        let (result, failure) = match ask(&mut client, sentence.clone()) {
            Ok(result) => {
                let is_false = matches!(&result, Outcome::Looked { looked, .. } if !looked.held);
                (result, is_false.then_some(Failure::NotHeld))
            }
            Err(ClientError::Refused(error)) => {
                let failure = twin::failure(ClientError::Refused(error.clone()));
                (Outcome::Refused { error }, Some(failure))
            }
            Err(error) => return Err(twin::failure(error)),
        };
        let fate = Fate { sentence, result };
        if args.json {
            document.sentences.push(fate);
        } else {
            People::Stdout.print_cases(&words(&fate))?;
        }
        failure.map_or(Ok(()), Err)
    });
    if args.json {
        output::print(output::json(&document)?.as_bytes())?;
    }
    ended
}

/// One line; a refused sentence has its message on stderr.
fn words(fate: &Fate) -> String {
    let Fate { sentence, result } = fate;
    match result {
        Outcome::Done { at_ns } => format!("ok      {}  {sentence}\n", time_words(*at_ns)),
        Outcome::Looked { at_ns, looked } if looked.held => {
            format!("ok      {}  {sentence}\n", time_words(*at_ns))
        }
        Outcome::Looked { at_ns, looked } => {
            let seen = looked.seen.as_deref().unwrap_or("it is not true");
            format!("FAILED  {}  {sentence}: {seen}\n", time_words(*at_ns))
        }
        Outcome::Refused { .. } => String::new(),
    }
}

/// Each sentence of the command line, and those of stdin as they come, until one fails.
fn each(sentences: &[String], mut take: impl FnMut(String) -> Result<(), Failure>) -> Result<(), Failure> {
    if are_words(sentences) {
        return take(sentences.join(" "));
    }
    for sentence in sentences {
        if sentence != STDIN {
            take(sentence.clone())?;
            continue;
        }
        for line in io::stdin().lines() {
            let line = line.map_err(|error| Failure::Refused {
                message: format!("cannot read stdin: {error}"),
                help: "write one sentence a line, in UTF-8".to_owned(),
            })?;
            let line = line.trim();
            if !line.is_empty() && !line.starts_with('#') {
                take(line.to_owned())?;
            }
        }
    }
    Ok(())
}

/// Whether these are the words of one sentence, without quotes: no sentence is a single word.
fn are_words(sentences: &[String]) -> bool {
    let is_word = |text: &String| text != STDIN && !text.contains(char::is_whitespace);
    sentences.len() > 1 && sentences.iter().all(is_word)
}

#[cfg(test)]
mod tests {
    use scenario::words::{CONDITIONS, CPU, LINE, UNIT};

    use super::*;

    fn taken(sentences: &[&str]) -> Vec<String> {
        let sentences: Vec<String> = sentences.iter().map(|text| (*text).to_owned()).collect();
        let mut taken = Vec::new();
        let ended = each(&sentences, |sentence| {
            taken.push(sentence);
            Ok(())
        });
        assert!(ended.is_ok());
        taken
    }

    #[test]
    fn words_without_quotes_are_one_sentence() {
        assert_eq!(taken(&["unplug", "cable", "1"]), ["unplug cable 1"]);
        assert_eq!(taken(&["unplug cable 1", "plug cable 1"]), ["unplug cable 1", "plug cable 1"]);
        assert_eq!(taken(&["unplug cable 1", "behave"]), ["unplug cable 1", "behave"]);
    }

    #[test]
    fn no_sentence_is_a_single_word() {
        let patterns = UNIT.iter().map(|row| row.pattern).chain(CPU.iter().map(|row| row.pattern));
        let patterns = patterns.chain(LINE.iter().map(|row| row.pattern));
        for pattern in patterns.chain(CONDITIONS.iter().map(|row| row.pattern)) {
            assert!(pattern.contains(' '), "{pattern}");
        }
    }
}
