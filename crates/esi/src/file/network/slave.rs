//! A slave of a network: what it is, where it is, and how the master sets it up.

use super::super::element::Element;
use super::super::pdo::PdoElement;
use super::super::place::Place;
use super::commands::RegisterCommand;
use super::process_data::NetworkSyncManager;
use super::slave_mailbox::NetworkMailbox;

/// An element `Slave`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NetworkSlave {
    /// Its place.
    pub place: Place,
    /// Its name.
    pub name: String,
    /// The ID of its vendor.
    pub vendor_id: Option<u32>,
    /// Its product code.
    pub product_code: Option<u32>,
    /// Its revision number.
    pub revision: Option<u32>,
    /// Its serial number; 0 if the master does not compare it.
    pub serial_number: u32,
    /// The address that the master gives it, `PhysAddr`.
    pub station_address: Option<u16>,
    /// Its place in the network, from 0: `AutoIncAddr` counts downwards.
    pub position: Option<u16>,
    /// Its ports: Y for a cable, K for a backplane, in the order of the ports.
    pub physics: String,
    /// By what the master knows it again.
    pub identification: Option<ExplicitIdentification>,
    /// Its SyncManagers, without those of the mailbox unless the file has them.
    pub sync_managers: Vec<NetworkSyncManager>,
    /// Its RxPDOs.
    pub rx_pdos: Vec<PdoElement>,
    /// Its TxPDOs.
    pub tx_pdos: Vec<PdoElement>,
    /// Its mailbox.
    pub mailbox: Option<NetworkMailbox>,
    /// Datagrams that the master sends at transitions.
    pub commands: Vec<RegisterCommand>,
    /// The ports behind which it may be.
    pub previous_ports: Vec<PreviousPort>,
    /// Its distributed clock.
    pub clock: Option<NetworkClock>,
    /// The group with which it may be absent.
    pub hot_connect_group: Option<String>,
}

/// A number by which the master knows a slave again: an alias, a switch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExplicitIdentification {
    /// The number.
    pub value: u16,
    /// The register in which it is; 0x0012 is the alias.
    pub register: Option<u16>,
}

/// An element `PreviousPort`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PreviousPort {
    /// Its place.
    pub place: Place,
    /// The station address of the slave before it.
    pub station_address: Option<u16>,
    /// The port of that slave: A is 0, B 1, C 2, D 3.
    pub port: Option<u8>,
    /// Whether it is the one that is in use.
    pub is_selected: bool,
}

/// An element `DC`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NetworkClock {
    /// Whether it is the clock that the others follow.
    pub is_reference: bool,
    /// The cycle of SYNC0 in nanoseconds; 0 without.
    pub cycle_time_0_ns: u32,
    /// The cycle of SYNC1 in nanoseconds, in some files negative.
    pub cycle_time_1_ns: i64,
    /// The shift of SYNC0 in nanoseconds.
    pub shift_time_ns: i64,
}

impl NetworkSlave {
    /// The port behind which it is: the selected one, else the first one.
    #[must_use]
    pub fn previous_port(&self) -> Option<&PreviousPort> {
        let ports = &self.previous_ports;
        ports.iter().find(|port| port.is_selected).or_else(|| ports.first())
    }

    /// All PDOs.
    pub fn pdos(&self) -> impl Iterator<Item = &PdoElement> {
        self.rx_pdos.iter().chain(&self.tx_pdos)
    }

    pub(super) fn read(element: Element<'_>) -> Self {
        let info = element.child("Info").unwrap_or(element);
        let process_data = element.child("ProcessData");
        let pdos = |name| {
            let elements = process_data.into_iter().flat_map(move |data: Element<'_>| data.all(name));
            elements.filter_map(PdoElement::read).collect()
        };
        let commands = element.child("InitCmds").into_iter().flat_map(|commands| commands.all("InitCmd"));
        Self {
            place: element.place(),
            name: info.localized("Name"),
            vendor_id: info.wrapping_32("VendorId"),
            product_code: info.wrapping_32("ProductCode"),
            revision: info.wrapping_32("RevisionNo"),
            serial_number: info.wrapping_32("SerialNo").unwrap_or(0),
            station_address: info.wrapping_16("PhysAddr"),
            position: info.wrapping_16("AutoIncAddr").map(u16::wrapping_neg),
            physics: info.text_of("Physics").to_owned(),
            identification: info.child("Identification").and_then(ExplicitIdentification::read),
            sync_managers: process_data.map(NetworkSyncManager::read_all).unwrap_or_default(),
            rx_pdos: pdos("RxPdo"),
            tx_pdos: pdos("TxPdo"),
            mailbox: element.child("Mailbox").map(NetworkMailbox::read),
            commands: commands.filter_map(RegisterCommand::read).collect(),
            previous_ports: element.all("PreviousPort").map(PreviousPort::read).collect(),
            clock: element.child("DC").map(NetworkClock::read),
            hot_connect_group: element.child("HotConnect").map(|group| group.text_of("GroupName").to_owned()),
        }
    }
}

impl ExplicitIdentification {
    fn read(element: Element<'_>) -> Option<Self> {
        Some(Self { value: element.attribute("Value")?.wrapping_16()?, register: element.wrapping_16("Ado") })
    }
}

impl PreviousPort {
    fn read(element: Element<'_>) -> Self {
        let port = match element.text_of("Port") {
            "A" => Some(0),
            "B" => Some(1),
            "C" => Some(2),
            "D" => Some(3),
            _ => None,
        };
        Self {
            place: element.place(),
            station_address: element.wrapping_16("PhysAddr"),
            port,
            is_selected: element.flag("Selected"),
        }
    }
}

impl NetworkClock {
    fn read(element: Element<'_>) -> Self {
        Self {
            is_reference: element.value_of("ReferenceClock").is_some_and(|value| value.flag()),
            cycle_time_0_ns: element.number_of("CycleTime0").unwrap_or(0),
            cycle_time_1_ns: element.number_of("CycleTime1").unwrap_or(0),
            shift_time_ns: element.number_of("ShiftTime").unwrap_or(0),
        }
    }
}
