//! Identity, ports and group of a device.

use std::collections::BTreeMap;

use super::finding::Report;
use super::rules;
use crate::file::DeviceElement;

/// Devices that no number distinguishes.
pub(crate) fn check_all(devices: &[DeviceElement], report: &dyn Report) {
    let mut first = BTreeMap::new();
    for device in devices {
        let device_type = &device.device_type;
        let (Some(product), Some(revision)) = (device_type.product_code, device_type.revision) else {
            continue;
        };
        let place = *first.entry((device.vendor.id, product, revision)).or_insert(device.place);
        if place != device.place {
            let line = place.line;
            let message = format!(
                "product code 0x{product:08X} with revision 0x{revision:08X} is in line {line} too; the first one is used"
            );
            report.report(rules::DEVICE_TWICE, device.place, message);
        }
    }
}

pub(super) fn check(device: &DeviceElement, report: &dyn Report) {
    let device_type = &device.device_type;
    let missing = |rule, message: &str| report.report(rule, device.place, message.to_owned());
    if device_type.product_code.is_none() {
        missing(rules::PRODUCT_CODE, "the device has no product code");
    }
    if device_type.revision.is_none() {
        missing(rules::REVISION, "the device has no revision number; read as 0");
    }
    if device_type.order_code.is_empty() {
        missing(rules::ORDER_CODE, "the device has no order code");
    }
    if device.physics.is_none() {
        let ports = if device.info.ebus_current_ma.is_some() { "KK" } else { "YY" };
        missing(rules::PHYSICS, &format!("the device does not say which ports it has; read as {ports}"));
    }
    if device.group.is_none() {
        match user_file::shown(&device.group_type).as_str() {
            "" => missing(rules::GROUP, "the device has no group"),
            group => missing(
                rules::GROUP,
                &format!("the file has no group `{group}`; its key is used as its name"),
            ),
        }
    }
}
