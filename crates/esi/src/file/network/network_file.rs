//! A whole network file: the slaves in their order, how they are connected, and the findings.

use super::super::document;
use super::super::element::Element;
use super::super::read_error::ReadError;
use super::slave::NetworkSlave;
use crate::lint;
use crate::lint::finding::Findings;
use crate::lint::rules;

/// The root element.
const ROOT: &str = "EtherCATConfig";

/// A network file (ENI).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NetworkFile {
    /// The slaves, in the order of the file: that of a frame that passes them.
    pub slaves: Vec<NetworkSlave>,
    /// The cycle of the process data in microseconds, if the file has one.
    pub cycle_time_us: Option<u32>,
    /// What is wrong with the file.
    pub findings: Findings,
}

/// The port to which a slave is connected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Attachment {
    /// The slave before it, by its place in the file.
    pub slave: usize,
    /// The port of that slave; none if the file does not say.
    pub port: Option<u8>,
}

impl NetworkFile {
    /// Maximum number of slaves of a network.
    pub const SLAVES_MAX: usize = 65_535;

    /// Reads a file.
    pub fn read(bytes: &[u8]) -> Result<Self, ReadError> {
        let ((slaves, cycle_time_us), findings) = document::read(bytes, |reading| {
            let root = Element::root(reading);
            if root.name() != ROOT {
                let (place, root) = (root.place(), root.name().to_owned());
                return Err(ReadError::AnotherRoot { place, root, expected: ROOT });
            }
            let slaves = slaves(root);
            lint::check_network(&slaves, reading);
            Ok((slaves, root.at(&["Config", "Cyclic"]).and_then(|cyclic| cyclic.number_of("CycleTime"))))
        })?;
        Ok(Self { slaves, cycle_time_us, findings: findings.sorted() })
    }

    /// To what a slave is connected: to the port that the file names, else to the slave before it. None: to the master.
    #[must_use]
    pub fn attachment(&self, slave: usize) -> Option<Attachment> {
        let before = self.slaves.get(..slave)?;
        let named = self.slaves.get(slave)?.previous_port().and_then(|previous| {
            let is_it = |other: &NetworkSlave| other.station_address == previous.station_address;
            let (slave, port) = (before.iter().position(is_it)?, previous.port);
            Some(Attachment { slave, port })
        });
        named.or_else(|| Some(Attachment { slave: slave.checked_sub(1)?, port: None }))
    }
}

fn slaves(root: Element<'_>) -> Vec<NetworkSlave> {
    let Some(config) = root.child("Config") else { return Vec::new() };
    if let Some(first) = config.all("Slave").nth(NetworkFile::SLAVES_MAX) {
        let message =
            format!("the network has more than {} slaves; the others are dropped", NetworkFile::SLAVES_MAX);
        first.report(rules::TOO_MANY_SLAVES, message);
    }
    config.all("Slave").take(NetworkFile::SLAVES_MAX).map(NetworkSlave::read).collect()
}
