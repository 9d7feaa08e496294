//! The answer to a frame: the result of each of its datagrams, for the part of the master that has sent it.

use wire::DatagramViews;

use crate::access::Answer;
use crate::part::Part;

/// A frame that has returned, from [`crate::Flights::arrive`]. [`crate::Flights::recycle`] takes its memory back.
#[derive(Debug)]
pub struct Arrival<'f, S> {
    parts: Vec<Part<S>>,
    /// From the first datagram on.
    datagrams: DatagramViews<'f>,
}

impl<'f, S> Arrival<'f, S> {
    /// `datagrams` are the answers to `parts`, one to each.
    pub(crate) const fn new(parts: Vec<Part<S>>, datagrams: DatagramViews<'f>) -> Self {
        Self { parts, datagrams }
    }

    /// The sender of each datagram and its answer, in the order of the frame.
    pub fn answers(&self) -> impl Iterator<Item = (&S, Answer<'f>)> {
        let answers = self.datagrams.clone().map(|datagram| Answer::of(&datagram));
        self.parts.iter().map(|part| &part.sender).zip(answers)
    }

    pub(crate) fn into_parts(self) -> Vec<Part<S>> {
        self.parts
    }
}
