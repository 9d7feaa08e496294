//! The description of a device for the slave stack.

use device::{DeviceConfig, EscConfig, PortKind, SyncMode};
use esi::file::{DeviceElement, PdoElement};
use esi::{DeviceDescription, PortPhysics};

use crate::not_yet::NotYet;
use crate::process_data::process_data;

/// SyncManagers and FMMUs of a device whose file does not indicate them.
const CHANNELS: usize = 8;
/// SyncManagers of the largest controller.
const CHANNELS_MAX: usize = 16;
/// Bytes of a KiB.
const KIB: u32 = 1_024;

/// The stack of a device: outputs are applied at the end of a frame.
///
/// # Errors
/// [`NotYet`], if the device needs what is not there yet.
pub fn device_config(element: &DeviceElement) -> Result<DeviceConfig, NotYet> {
    let described = element.description();
    refuse_what_is_missing(element, &described)?;
    Ok(DeviceConfig {
        esc: controller(element, &described),
        sii_image: esi::sii::image(&described),
        process_data: process_data(&described)?,
        sync_modes: &[SyncMode::EndOfFrame],
        ..DeviceConfig::default()
    })
}

fn refuse_what_is_missing(element: &DeviceElement, described: &DeviceDescription) -> Result<(), NotYet> {
    let count = described.sync_managers.len();
    match () {
        () if described.mailbox.is_some() => Err(NotYet::Mailbox),
        () if element.slots.is_some() => Err(NotYet::Slots),
        () if !element.sub_devices.is_empty() => Err(NotYet::SubDevices),
        () if count > CHANNELS_MAX => Err(NotYet::SyncManagers { count }),
        () => excluded(element).map_or(Ok(()), |pdo| Err(NotYet::Exclusion { pdo })),
    }
}

/// The first assigned PDO that excludes another assigned one.
fn excluded(element: &DeviceElement) -> Option<u16> {
    let assigned = || element.pdos().filter(|pdo| pdo.sync_manager.is_some());
    let excludes = |pdo: &&PdoElement| assigned().any(|other| pdo.excludes.contains(&other.index));
    assigned().find(excludes).map(|pdo| pdo.index.index.0)
}

fn controller(element: &DeviceElement, described: &DeviceDescription) -> EscConfig {
    let usual = EscConfig::default();
    let memory_kib = element.info.memory_bytes.and_then(|bytes| u8::try_from(bytes / KIB).ok());
    EscConfig {
        sync_manager_count: channels(element.info.sync_manager_count, described.sync_managers.len()),
        fmmu_count: channels(element.info.fmmu_count, described.fmmus.len()),
        ram_kib: memory_kib.filter(|&kib| kib > 0).unwrap_or(usual.ram_kib),
        ports: described.ports.map(port),
        ..usual
    }
}

/// As many as the file indicates, 8 without an indication, and never fewer than it describes.
fn channels(indicated: Option<u8>, described: usize) -> u8 {
    let count = indicated.map_or(CHANNELS, usize::from).max(described).min(CHANNELS_MAX);
    u8::try_from(count).unwrap_or(u8::MAX)
}

const fn port(physics: PortPhysics) -> PortKind {
    match physics {
        PortPhysics::Unused | PortPhysics::Other(_) => PortKind::Missing,
        PortPhysics::Ebus => PortKind::Ebus,
        PortPhysics::Mii | PortPhysics::FastHotConnect => PortKind::Mii,
    }
}
