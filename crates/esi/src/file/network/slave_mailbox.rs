//! The mailbox of a slave in a network.

use super::super::element::Element;
use super::super::mailbox::PROTOCOLS;
use super::super::place::Place;
use super::commands::CoeCommand;
use crate::MailboxProtocols;

/// An element `Mailbox`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NetworkMailbox {
    /// Its place.
    pub place: Place,
    /// The area that the master writes, element `Send`.
    pub to_slave: Option<MailboxBuffer>,
    /// The area that the master reads, element `Recv`, in some files `Receive`.
    pub from_slave: Option<MailboxBuffer>,
    /// Both in BOOT, the one that the master writes first.
    pub bootstrap: Option<(MailboxBuffer, MailboxBuffer)>,
    /// The protocols.
    pub protocols: MailboxProtocols,
    /// SDOs that the master sends.
    pub coe_commands: Vec<CoeCommand>,
}

/// An area of the mailbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MailboxBuffer {
    /// Where it begins.
    pub start: u16,
    /// Its length.
    pub bytes: u16,
}

impl NetworkMailbox {
    pub(super) fn read(element: Element<'_>) -> Self {
        let coe = element.at(&["CoE", "InitCmds"]);
        Self {
            place: element.place(),
            to_slave: MailboxBuffer::to_slave(element),
            from_slave: MailboxBuffer::from_slave(element),
            bootstrap: element
                .child("BootStrap")
                .and_then(|boot| MailboxBuffer::to_slave(boot).zip(MailboxBuffer::from_slave(boot))),
            protocols: protocols(element),
            coe_commands: coe
                .into_iter()
                .flat_map(|commands| commands.all("InitCmd"))
                .filter_map(CoeCommand::read)
                .collect(),
        }
    }
}

/// By elements `Protocol`, and by the elements of the protocols themselves.
fn protocols(element: Element<'_>) -> MailboxProtocols {
    let is_named = |name: &'static str| {
        element.child(name).is_some() || element.all("Protocol").any(|protocol| protocol.text() == name)
    };
    PROTOCOLS.into_iter().filter(|(name, _)| is_named(name)).map(|(_, protocol)| protocol).collect()
}

impl MailboxBuffer {
    fn to_slave(element: Element<'_>) -> Option<Self> {
        Self::read(element.child("Send")?)
    }

    fn from_slave(element: Element<'_>) -> Option<Self> {
        Self::read(element.child("Recv").or_else(|| element.child("Receive"))?)
    }

    fn read(element: Element<'_>) -> Option<Self> {
        Some(Self { start: element.wrapping_16("Start")?, bytes: element.wrapping_16("Length")? })
    }
}
