//! The mailbox: protocols, the services of CoE, init commands.

use wire::{ObjectIndex, SubIndex};

use super::element::Element;
use super::place::Place;
use crate::lint::rules;
use crate::{CoeDetails, MailboxProtocols, Transition};

/// An element `Mailbox`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MailboxElement {
    /// Its place.
    pub place: Place,
    /// Whether lost replies are repeated.
    pub data_link_layer: bool,
    /// The protocols.
    pub protocols: MailboxProtocols,
    /// CoE; none without an element `CoE`.
    pub coe: Option<CoeElement>,
}

/// An element `CoE`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CoeElement {
    /// Its place.
    pub place: Place,
    /// The services, as SII category 30 has them.
    pub details: CoeDetails,
    /// Whether long values are transferred in segments, if indicated.
    pub segmented_sdo: Option<bool>,
    /// Whether there is a diagnosis history, 0x10F3.
    pub diag_history: bool,
    /// The number of CiA 402 axes, if indicated.
    pub ds402_channels: Option<u8>,
    /// The SDOs that the master writes at start-up.
    pub init_commands: Vec<InitCommandElement>,
}

/// An element `InitCmd`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InitCommandElement {
    /// Its place.
    pub place: Place,
    /// The transitions at which it is written.
    pub transitions: Vec<Transition>,
    /// Index of the entry.
    pub index: ObjectIndex,
    /// Whether the increment of the slots is added to the index.
    pub depends_on_slot: bool,
    /// Subindex of the entry.
    pub sub: SubIndex,
    /// The value.
    pub data: Vec<u8>,
    /// Whether it is a complete access.
    pub complete_access: bool,
    /// Whether a user of the configuration tool cannot change it.
    pub fixed: bool,
    /// The reason.
    pub comment: String,
}

/// The protocols by the names of their elements.
pub(super) const PROTOCOLS: [(&str, MailboxProtocols); 6] = [
    ("AoE", MailboxProtocols::AOE),
    ("EoE", MailboxProtocols::EOE),
    ("CoE", MailboxProtocols::COE),
    ("FoE", MailboxProtocols::FOE),
    ("SoE", MailboxProtocols::SOE),
    ("VoE", MailboxProtocols::VOE),
];

/// The services of CoE by the names of their attributes.
pub(crate) const COE_DETAILS: [(&str, CoeDetails); 5] = [
    ("SdoInfo", CoeDetails::SDO_INFO),
    ("PdoAssign", CoeDetails::PDO_ASSIGN),
    ("PdoConfig", CoeDetails::PDO_CONFIG),
    ("PdoUpload", CoeDetails::PDO_UPLOAD),
    ("CompleteAccess", CoeDetails::COMPLETE_ACCESS),
];

impl MailboxElement {
    pub(super) fn read(element: Element<'_>) -> Self {
        let present = PROTOCOLS.into_iter().filter(|(name, _)| element.child(name).is_some());
        Self {
            place: element.place(),
            data_link_layer: element.flag("DataLinkLayer"),
            protocols: present.map(|(_, protocol)| protocol).collect(),
            coe: element.child("CoE").map(CoeElement::read),
        }
    }
}

impl CoeElement {
    fn read(element: Element<'_>) -> Self {
        let set = COE_DETAILS.into_iter().filter(|(name, _)| element.flag(name));
        Self {
            place: element.place(),
            details: set.map(|(_, detail)| detail).collect::<CoeDetails>() | CoeDetails::SDO,
            segmented_sdo: element.attribute("SegmentedSdo").map(|value| value.flag()),
            diag_history: element.flag("DiagHistory"),
            ds402_channels: element.number("DS402Channels"),
            init_commands: element.all("InitCmd").filter_map(InitCommandElement::read).collect(),
        }
    }
}

impl InitCommandElement {
    /// A command without an index is dropped.
    fn read(element: Element<'_>) -> Option<Self> {
        let Some(index) = element.number_of("Index") else {
            element.report(rules::INIT_COMMAND_UNUSABLE, "the init command has no index; dropped".into());
            return None;
        };
        Some(Self {
            place: element.place(),
            transitions: transitions(element, &[]),
            index: ObjectIndex(index),
            depends_on_slot: element.child("Index").is_some_and(|index| index.flag("DependOnSlot")),
            sub: SubIndex(element.number_of("SubIndex").unwrap_or(0)),
            data: element.value_of("Data").and_then(|data| data.bytes()).unwrap_or_default(),
            complete_access: element.flag("CompleteAccess"),
            fixed: element.flag("Fixed"),
            comment: element.localized("Comment"),
        })
    }
}

/// The transitions of a command, each once; those in `others` are no transitions from state to state, and are left out.
pub(super) fn transitions(command: Element<'_>, others: &[&str]) -> Vec<Transition> {
    let mut transitions = Vec::new();
    let texts = command.all("Transition").filter(|element| !others.contains(&element.text()));
    for transition in texts.filter_map(transition) {
        if !transitions.contains(&transition) {
            transitions.push(transition);
        }
    }
    transitions
}

fn transition(element: Element<'_>) -> Option<Transition> {
    let found = Transition::ALL.into_iter().find(|transition| transition.letters() == element.text());
    if found.is_none() {
        element.value().report(rules::INIT_COMMAND_UNUSABLE, "is no transition; dropped");
    }
    found
}
