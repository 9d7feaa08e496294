//! A set of positions in a line, which finds its members in order without a look at the others.

/// Positions per word.
const WORD: usize = u64::BITS as usize;

/// A set of positions below a fixed number. Nothing is allocated after [`Positions::new`].
#[derive(Clone, Debug)]
pub struct Positions {
    /// A bit for each position.
    words: Box<[u64]>,
    /// A bit for each word that is not 0.
    filled: Box<[u64]>,
}

/// Some positions of one word.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Word {
    number: usize,
    members: u64,
}

/// Positions that are gathered in order or nearly so: the set is used only for what the last word does not hold, which
/// is nothing on a short line.
pub(crate) struct Gathered<'a> {
    last: Word,
    /// Empty in the end, and before.
    others: &'a mut Positions,
}

impl<'a> Gathered<'a> {
    /// None yet.
    #[inline]
    pub(crate) const fn new(others: &'a mut Positions) -> Self {
        Self { last: Word { number: 0, members: 0 }, others }
    }

    /// Whether there is none: as long as no word has been taken out, some of the last word are here.
    #[inline]
    pub(crate) const fn is_empty(&self) -> bool {
        self.last.members == 0
    }

    /// Adds a position.
    #[inline]
    pub(crate) fn insert(&mut self, position: usize) {
        if position / WORD != self.last.number {
            self.others.insert_word(self.last);
            self.last = Word { number: position / WORD, members: 0 };
        }
        self.last.members |= 1 << (position % WORD);
    }

    /// Puts those of the last word into the set too.
    #[inline]
    pub(crate) fn finish(self) {
        self.others.insert_word(self.last);
    }

    /// Takes all out.
    #[inline]
    pub(crate) fn clear(&mut self) {
        while self.take_word().is_some() {}
    }

    /// Takes the positions of a word out, some word that has some.
    #[inline]
    pub(crate) fn take_word(&mut self) -> Option<Word> {
        if self.last.members == 0 {
            return self.others.take_word();
        }
        Some(Word { members: core::mem::take(&mut self.last.members), ..self.last })
    }
}

impl Word {
    /// Takes the first position out.
    #[inline]
    pub(crate) fn take_first(&mut self) -> Option<usize> {
        if self.members == 0 {
            return None;
        }
        let position = self.number * WORD + self.members.trailing_zeros() as usize;
        self.members &= self.members - 1;
        Some(position)
    }
}

impl Positions {
    /// The empty set of positions below `length`.
    #[must_use]
    pub fn new(length: usize) -> Self {
        let words = length.div_ceil(WORD);
        Self {
            words: vec![0; words].into_boxed_slice(),
            filled: vec![0; words.div_ceil(WORD)].into_boxed_slice(),
        }
    }

    /// Whether it has no member.
    #[inline]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.filled.iter().all(|filled| *filled == 0)
    }

    /// Adds a position; one beyond the length is left out.
    #[inline]
    pub fn insert(&mut self, position: usize) {
        self.insert_word(Word { number: position / WORD, members: 1 << (position % WORD) });
    }

    /// Adds the positions of a word.
    #[inline]
    pub(crate) fn insert_word(&mut self, Word { number, members }: Word) {
        if let Some(word) = self.words.get_mut(number)
            && members != 0
        {
            *word |= members;
            self.filled[number / WORD] |= 1 << (number % WORD);
        }
    }

    /// Takes the positions of the first word that has some out.
    #[inline]
    pub(crate) fn take_word(&mut self) -> Option<Word> {
        let (at, filled) = self.filled.iter_mut().enumerate().find(|(_, filled)| **filled != 0)?;
        let number = at * WORD + filled.trailing_zeros() as usize;
        *filled &= *filled - 1;
        Some(Word { number, members: core::mem::take(&mut self.words[number]) })
    }

    /// Takes a position out.
    #[inline]
    pub fn remove(&mut self, position: usize) {
        let word = position / WORD;
        if let Some(bits) = self.words.get_mut(word) {
            *bits &= !(1 << (position % WORD));
            if *bits == 0 {
                self.filled[word / WORD] &= !(1 << (word % WORD));
            }
        }
    }

    /// Whether a position is a member.
    #[inline]
    #[must_use]
    pub fn contains(&self, position: usize) -> bool {
        let word = self.words.get(position / WORD).copied().unwrap_or_default();
        word >> (position % WORD) & 1 != 0
    }

    /// The first member from `from` on.
    #[inline]
    #[must_use]
    pub fn next(&self, from: usize) -> Option<usize> {
        let word = from / WORD;
        let here = self.words.get(word)? & u64::MAX << (from % WORD);
        if here != 0 {
            return Some(word * WORD + here.trailing_zeros() as usize);
        }
        let word = self.next_filled(word + 1)?;
        Some(word * WORD + self.words[word].trailing_zeros() as usize)
    }

    /// The first word from `from` on that is not 0.
    fn next_filled(&self, from: usize) -> Option<usize> {
        let mut at = from / WORD;
        let mut filled = self.filled.get(at)? & u64::MAX << (from % WORD);
        while filled == 0 {
            at += 1;
            filled = *self.filled.get(at)?;
        }
        Some(at * WORD + filled.trailing_zeros() as usize)
    }

    /// Its members in order.
    pub fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        let mut from = 0;
        core::iter::from_fn(move || {
            let position = self.next(from)?;
            from = position + 1;
            Some(position)
        })
    }

    /// Takes all members out.
    pub fn clear(&mut self) {
        while self.take_word().is_some() {}
    }

    /// Moves all members of `others` here, which is empty then. Both are of one line.
    #[inline]
    pub fn take_all(&mut self, others: &mut Self) {
        while let Some(word) = others.take_word() {
            self.insert_word(word);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    #[test]
    fn a_position_beyond_the_length_is_no_member() {
        let mut positions = Positions::new(64);
        positions.insert(64);
        positions.remove(64);
        assert!(positions.is_empty() && positions.next(0).is_none() && positions.next(64).is_none());
    }

    proptest! {
        /// Against a sorted set of the standard library, over several words of words.
        #[test]
        fn members_come_in_order(
            changes in prop::collection::vec((0usize..9_000, any::<bool>()), 0..60),
            from in 0usize..9_100,
            others in prop::collection::btree_set(0usize..9_000, 0..20),
        ) {
            let (mut positions, mut model) = (Positions::new(9_000), BTreeSet::new());
            for (position, inserts) in changes {
                if inserts {
                    positions.insert(position);
                    model.insert(position);
                } else {
                    // Mostly one that is there.
                    let member = model.range(position..).next().copied().unwrap_or(position);
                    positions.remove(member);
                    model.remove(&member);
                }
                prop_assert_eq!(positions.is_empty(), model.is_empty());
            }
            prop_assert!(positions.iter().eq(model.iter().copied()));
            prop_assert_eq!(positions.contains(from), model.contains(&from));
            prop_assert_eq!(positions.next(from), model.range(from..).next().copied());
            let mut more = Positions::new(9_000);
            others.iter().for_each(|position| more.insert(*position));
            positions.take_all(&mut more);
            model.extend(others);
            prop_assert!(more.is_empty() && more.iter().next().is_none());
            prop_assert!(positions.iter().eq(model.iter().copied()));
            positions.clear();
            prop_assert!(positions.is_empty() && (0..9_000).all(|position| !positions.contains(position)));
        }
    }
}
