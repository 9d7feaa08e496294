//! Shrinking a failing input: parts are removed as long as it still fails (delta debugging).

use std::time::{Duration, Instant};

use crate::fuzzer::Grain;

/// Time limit.
const PATIENCE: Duration = Duration::from_secs(20);

/// The smallest input found that still fails. `fails` is called for each attempt.
pub(crate) fn shrink(input: &[u8], grains: &[Grain], mut fails: impl FnMut(&[u8]) -> bool) -> Vec<u8> {
    let end = Instant::now() + PATIENCE;
    let mut smallest = input.to_vec();
    loop {
        let before = smallest.len();
        for grain in grains {
            smallest = leave_out(smallest, *grain, &mut fails, end);
        }
        if smallest.len() == before || Instant::now() >= end {
            return smallest;
        }
    }
}

/// Removes runs of parts: half of them, a quarter, down to single ones.
fn leave_out(
    mut input: Vec<u8>,
    grain: Grain,
    fails: &mut impl FnMut(&[u8]) -> bool,
    end: Instant,
) -> Vec<u8> {
    let mut run = grain.parts(&input).len().div_ceil(2);
    while run > 0 {
        let mut at = 0;
        loop {
            let parts = grain.parts(&input);
            if at >= parts.len() {
                break;
            }
            if Instant::now() >= end {
                return input;
            }
            let behind = (at + run).min(parts.len());
            let without = [&parts[..at], &parts[behind..]].concat().concat();
            if without.len() < input.len() && fails(&without) {
                input = without;
            } else {
                at = behind;
            }
        }
        run /= 2;
    }
    input
}

impl Grain {
    /// The parts of an input; together they are the whole input.
    fn parts(self, input: &[u8]) -> Vec<&[u8]> {
        match self {
            Self::Lines => input.split_inclusive(|byte| *byte == b'\n').collect(),
            Self::Clauses => input.split_inclusive(|byte| *byte == b';' || *byte == b'\n').collect(),
            Self::Words => input.chunk_by(|one, next| is_word(*one) && is_word(*next)).collect(),
            Self::Pairs => input.chunks(2).collect(),
            Self::Bytes => input.chunks(1).collect(),
        }
    }
}

const fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte >= 0x80
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Grain; 5] = [Grain::Lines, Grain::Clauses, Grain::Words, Grain::Pairs, Grain::Bytes];

    #[test]
    fn what_is_left_still_fails_and_nothing_more_can_go() {
        let input = b"first line\nx := bad; y := 2;\nthe last, worse line\n";
        let fails = |input: &[u8]| {
            let has = |word: &[u8]| input.windows(word.len()).any(|part| part == word);
            has(b"bad") && has(b"worse")
        };
        assert_eq!(shrink(input, &ALL, fails), b"badworse");
        assert_eq!(shrink(input, &[Grain::Lines], fails), b"x := bad; y := 2;\nthe last, worse line\n");
    }

    #[test]
    fn parts_are_all_of_the_input() {
        let input = "a b;c\n\nÄ_1+2".as_bytes();
        for grain in ALL {
            assert_eq!(grain.parts(input).concat(), input, "{grain:?}");
        }
        assert_eq!(Grain::Words.parts(b"ab_1 := 2").len(), 6);
    }
}
