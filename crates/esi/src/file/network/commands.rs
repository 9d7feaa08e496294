//! Init commands: what the master sends to a slave at a transition.

use wire::{ObjectIndex, SubIndex};

use super::super::element::Element;
use super::super::mailbox::transitions;
use super::super::place::Place;
use crate::Transition;
use crate::lint::rules;

/// Commands for a slave that stays in its state are no transitions: `II` is sent when the master begins.
const STAYS: [&str; 5] = ["II", "PP", "SS", "OO", "BB"];

/// A datagram of the master.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RegisterCommand {
    /// Its place.
    pub place: Place,
    /// The transitions at which it is sent.
    pub transitions: Vec<Transition>,
    /// Whether it is sent when the master begins, `II`.
    pub at_beginning: bool,
    /// The command of the datagram, as in the frame: 4 is FPRD, 5 FPWR.
    pub command: u8,
    /// Whom it addresses.
    pub target: Target,
    /// The data that are sent; zeros where the master reads.
    pub data: Vec<u8>,
    /// The working counter that the master expects, if it expects one.
    pub working_counter: Option<u16>,
    /// The reason.
    pub comment: String,
}

/// What a datagram addresses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Registers or memory of a slave.
    Slave {
        /// Its position or its station address, as the command says.
        address: u16,
        /// The register.
        register: u16,
    },
    /// A logical address.
    Logical(u32),
}

impl RegisterCommand {
    /// A command without number or address is dropped.
    pub(super) fn read(element: Element<'_>) -> Option<Self> {
        let found = element.number_of("Cmd").zip(target(element));
        let Some((command, target)) = found else {
            let message = "the init command has no Cmd or no address; dropped".into();
            element.report(rules::NETWORK_COMMAND, message);
            return None;
        };
        let data = element.value_of("Data").and_then(|data| data.bytes());
        let length = || usize::from(element.number_of::<u16>("DataLength").unwrap_or(0));
        Some(Self {
            place: element.place(),
            transitions: transitions(element, &STAYS),
            at_beginning: is_at_beginning(element),
            command,
            target,
            data: data.unwrap_or_else(|| vec![0; length()]),
            working_counter: element.number_of("Cnt"),
            comment: element.localized("Comment"),
        })
    }
}

fn target(element: Element<'_>) -> Option<Target> {
    let address = element.child("Adp").map(|_| element.wrapping_16("Adp").unwrap_or(0));
    match (address, element.child("Ado")) {
        (Some(address), Some(_)) => {
            element.wrapping_16("Ado").map(|register| Target::Slave { address, register })
        }
        _ => element.wrapping_32("Addr").map(Target::Logical),
    }
}

fn is_at_beginning(command: Element<'_>) -> bool {
    command.all("Transition").any(|transition| transition.text() == "II")
}

/// An SDO of the master.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CoeCommand {
    /// Its place.
    pub place: Place,
    /// The transitions at which it is sent.
    pub transitions: Vec<Transition>,
    /// Index of the entry.
    pub index: ObjectIndex,
    /// Subindex of the entry.
    pub sub: SubIndex,
    /// The value that is written; empty if the entry is read.
    pub data: Vec<u8>,
    /// Whether it is a complete access.
    pub complete_access: bool,
    /// Whether the master leaves it out.
    pub is_disabled: bool,
    /// The reason.
    pub comment: String,
}

impl CoeCommand {
    /// A command without an index is dropped.
    pub(super) fn read(element: Element<'_>) -> Option<Self> {
        let Some(index) = element.wrapping_16("Index") else {
            element.report(rules::NETWORK_COMMAND, "the init command has no Index; dropped".into());
            return None;
        };
        Some(Self {
            place: element.place(),
            transitions: transitions(element, &STAYS),
            index: ObjectIndex(index),
            sub: SubIndex(element.number_of("SubIndex").unwrap_or(0)),
            data: element.value_of("Data").and_then(|data| data.bytes()).unwrap_or_default(),
            complete_access: element.flag("CompleteAccess"),
            is_disabled: element.value_of("Disabled").is_some_and(|value| value.flag()),
            comment: element.localized("Comment"),
        })
    }
}
