//! The records of the twin, for the clients that have subscribed them.

use std::sync::Arc;

use super::postbox::{Post, Postbox};
use super::subscription::Kinds;

/// Gives records to the clients. It never waits.
#[derive(Clone, Debug)]
pub struct Publisher {
    kinds: Arc<Kinds>,
    postbox: Arc<Postbox>,
}

impl Publisher {
    pub(super) const fn new(kinds: Arc<Kinds>, postbox: Arc<Postbox>) -> Self {
        Self { kinds, postbox }
    }

    /// Publishes records: the kind of each and its JSON, without the end of its line.
    pub fn publish<'a>(&self, records: impl IntoIterator<Item = (&'a str, String)>) {
        let posts = records.into_iter().map(|(kind, mut line)| {
            line.push('\n');
            Post::Record { kind: self.kinds.kind(kind), line: line.into() }
        });
        self.postbox.post(posts);
    }
}
