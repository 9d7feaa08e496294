//! Sentences inside a sentence: `(unit 1 is in OP; 100 cycles are done)`.

use crate::model::LOGIC_DEPTH_MAX;

/// The sentences of a group in parentheses, and the number of its words. None if it has no end, an empty sentence, or
/// parentheses that are nested too deep.
pub(super) fn group(words: &[&str]) -> Option<(Vec<String>, usize)> {
    words.first().filter(|first| first.starts_with('('))?;
    let mut reading = Reading::default();
    for (at, word) in words.iter().enumerate() {
        if at > 0 {
            reading.space();
        }
        let mut letters = word.chars();
        while let Some(letter) = letters.next() {
            reading.take(letter)?;
            if reading.depth == 0 {
                return letters.as_str().is_empty().then(|| reading.end()).flatten().map(|all| (all, at + 1));
            }
        }
    }
    None
}

/// The letters of a group so far.
#[derive(Default)]
struct Reading {
    /// Open parentheses.
    depth: usize,
    /// Inside a text of Structured Text, where parentheses and `;` are letters.
    is_text: bool,
    done: Vec<String>,
    /// The sentence that is being read.
    sentence: String,
}

impl Reading {
    fn space(&mut self) {
        self.sentence.push(' ');
    }

    fn take(&mut self, letter: char) -> Option<()> {
        match letter {
            '\'' => self.is_text = !self.is_text,
            '(' if !self.is_text => {
                self.depth += 1;
                (self.depth <= LOGIC_DEPTH_MAX).then_some(())?;
                if self.depth == 1 {
                    return Some(());
                }
            }
            ')' if !self.is_text => {
                self.depth -= 1;
                if self.depth == 0 {
                    return Some(());
                }
            }
            ';' if !self.is_text && self.depth == 1 => {
                return self.next_sentence();
            }
            _ => {}
        }
        self.sentence.push(letter);
        Some(())
    }

    fn next_sentence(&mut self) -> Option<()> {
        let sentence = core::mem::take(&mut self.sentence).trim().to_owned();
        (!sentence.is_empty()).then(|| self.done.push(sentence))
    }

    fn end(mut self) -> Option<Vec<String>> {
        self.next_sentence()?;
        Some(self.done)
    }
}
