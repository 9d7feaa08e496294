//! A device: its type, and all that follows from it.

use std::sync::Arc;

use super::channels::{FmmuElement, SyncManagerElement, SyncUnit};
use super::clock::ClockElement;
use super::eeprom::EepromElement;
use super::element::Element;
use super::info::InfoElement;
use super::mailbox::MailboxElement;
use super::pdo::PdoElement;
use super::place::Place;
use super::profile::ProfileElement;
use super::slots::SlotsElement;
use crate::lint::rules;
use crate::{EscPresets, Group, PortPhysics, Vendor};

/// An element `Device`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeviceElement {
    /// Its place.
    pub place: Place,
    /// Its type.
    pub device_type: DeviceType,
    /// Its name; the order code if it has none.
    pub name: String,
    /// The older revisions that it hides from the selection in configuration tools.
    pub hides: Vec<HiddenType>,
    /// Its vendor.
    pub vendor: Arc<Vendor>,
    /// Key of its group.
    pub group_type: String,
    /// Its group; none if the file has no group of this key.
    pub group: Option<Arc<Group>>,
    /// Its ports; none if they are not indicated.
    pub physics: Option<[PortPhysics; 4]>,
    /// Sizes, time-outs, current.
    pub info: InfoElement,
    /// Its profiles, with the dictionaries.
    pub profiles: Vec<ProfileElement>,
    /// The FMMUs, FMMU 0 first.
    pub fmmus: Vec<FmmuElement>,
    /// The SyncManagers, SyncManager 0 first.
    pub sync_managers: Vec<SyncManagerElement>,
    /// The sync units.
    pub sync_units: Vec<SyncUnit>,
    /// PDOs from master to slave.
    pub rx_pdos: Vec<PdoElement>,
    /// PDOs from slave to master.
    pub tx_pdos: Vec<PdoElement>,
    /// The mailbox; none for a device without one.
    pub mailbox: Option<MailboxElement>,
    /// Distributed clocks; none for a device without them.
    pub clock: Option<ClockElement>,
    /// The slots of a modular device.
    pub slots: Option<SlotsElement>,
    /// Registers that the master should preset.
    pub esc_presets: EscPresets,
    /// The EEPROM, if indicated.
    pub eeprom: Option<EepromElement>,
    /// Further controllers in the same housing.
    pub sub_devices: Vec<SubDevice>,
}

/// An element `Type`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DeviceType {
    /// The order code, its text.
    pub order_code: String,
    /// Product code; none if it is left out.
    pub product_code: Option<u32>,
    /// Revision number; none if it is left out.
    pub revision: Option<u32>,
    /// Serial number; 0: none.
    pub serial: u32,
    /// How a master compares the product code, such as `EQ`.
    pub check_product_code: Option<String>,
    /// How a master compares the revision number, such as `EQ_OR_G`.
    pub check_revision: Option<String>,
    /// Whether the device goes to SAFE-OP in configuration mode.
    pub safe_op_in_configuration_mode: bool,
    /// Whether the master should use LRD and LWR instead of LRW.
    pub use_lrd_lwr: bool,
}

/// An element `HideType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HiddenType {
    /// The product code; none: that of the device.
    pub product_code: Option<u32>,
    /// The revision; none: all.
    pub revision: Option<u32>,
}

/// An element `SubDevice`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SubDevice {
    /// Its place.
    pub place: Place,
    /// Its product code.
    pub product_code: Option<u32>,
    /// Its revision number.
    pub revision: Option<u32>,
    /// The controller before it: 0 is the device itself.
    pub previous_device: Option<u8>,
    /// The port of that one.
    pub previous_port: Option<u8>,
}

impl DeviceElement {
    pub(super) fn read(element: Element<'_>, vendor: &Arc<Vendor>, groups: &[Arc<Group>]) -> Self {
        let device_type = element.child("Type").map(DeviceType::read).unwrap_or_default();
        let name = element.localized("Name");
        let group_type = element.text_of("GroupType");
        Self {
            place: element.place(),
            name: if name.is_empty() { device_type.order_code.clone() } else { name },
            device_type,
            hides: element.all("HideType").map(HiddenType::read).collect(),
            vendor: Arc::clone(vendor),
            group_type: group_type.to_owned(),
            group: groups.iter().find(|group| group.group_type == group_type).cloned(),
            physics: physics(element),
            info: element.child("Info").map(InfoElement::read).unwrap_or_default(),
            profiles: element.all("Profile").map(ProfileElement::read).collect(),
            fmmus: element.all("Fmmu").map(FmmuElement::read).collect(),
            sync_managers: element.all("Sm").map(SyncManagerElement::read).collect(),
            sync_units: element.all("Su").map(SyncUnit::read).collect(),
            rx_pdos: element.all("RxPdo").filter_map(PdoElement::read).collect(),
            tx_pdos: element.all("TxPdo").filter_map(PdoElement::read).collect(),
            mailbox: element.child("Mailbox").map(MailboxElement::read),
            clock: element.child("Dc").map(ClockElement::read),
            slots: element.child("Slots").map(SlotsElement::read),
            esc_presets: element.child("ESC").map(esc_presets).unwrap_or_default(),
            eeprom: element.child("Eeprom").map(EepromElement::read),
            sub_devices: element.all("SubDevice").map(SubDevice::read).collect(),
        }
    }

    /// The PDOs of both directions.
    pub fn pdos(&self) -> impl Iterator<Item = &PdoElement> {
        self.rx_pdos.iter().chain(&self.tx_pdos)
    }
}

impl DeviceType {
    fn read(element: Element<'_>) -> Self {
        let text = |name| element.attribute(name).map(|value| value.text.to_owned());
        Self {
            order_code: element.text().to_owned(),
            product_code: element.number("ProductCode"),
            revision: element.number("RevisionNo"),
            serial: element.number("SerialNo").unwrap_or(0),
            check_product_code: text("CheckProductCode"),
            check_revision: text("CheckRevisionNo"),
            safe_op_in_configuration_mode: element.flag("TcCfgModeSafeOp"),
            use_lrd_lwr: element.flag("UseLrdLwr"),
        }
    }
}

impl HiddenType {
    fn read(element: Element<'_>) -> Self {
        Self { product_code: element.number("ProductCode"), revision: element.number("RevisionNo") }
    }
}

impl SubDevice {
    fn read(element: Element<'_>) -> Self {
        Self {
            place: element.place(),
            product_code: element.number("ProductCode"),
            revision: element.number("RevisionNo"),
            previous_device: element.number("PreviousDevice"),
            previous_port: element.number("PreviousPortNo"),
        }
    }
}

/// A letter for each port, a blank for an unused one; none if no port is used.
fn physics(element: Element<'_>) -> Option<[PortPhysics; 4]> {
    let letters = element.attribute_as_written("Physics").filter(|letters| !letters.trim().is_empty())?;
    let mut ports = [PortPhysics::Unused; 4];
    if letters.trim_end().chars().count() > ports.len() {
        element
            .report(rules::PHYSICS_LETTER, "Physics has more than four ports; the others are dropped".into());
    }
    for (port, letter) in ports.iter_mut().zip(letters.chars()) {
        *port = match letter {
            'Y' => PortPhysics::Mii,
            'K' => PortPhysics::Ebus,
            'H' => PortPhysics::FastHotConnect,
            ' ' => PortPhysics::Unused,
            'B' => {
                let message = "Physics has the old letter `B` for a backplane; read as K";
                element.report(rules::PHYSICS_LETTER, message.into());
                PortPhysics::Ebus
            }
            other => {
                let message =
                    format!("Physics has the unknown port `{}`; read as unused", other.escape_debug());
                element.report(rules::PHYSICS_LETTER, message);
                PortPhysics::Unused
            }
        };
    }
    Some(ports)
}

fn esc_presets(element: Element<'_>) -> EscPresets {
    EscPresets {
        read_write_offset: element.number_of("Reg0108"),
        watchdog_divider: element.number_of("Reg0400"),
        pdi_watchdog: element.number_of("Reg0410"),
        process_data_watchdog: element.number_of("Reg0420"),
    }
}
