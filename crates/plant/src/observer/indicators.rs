//! The indicators of a unit, compared with the patterns that are known.

use coe_kit::indicators::{Pattern, PortCondition};
use device::{Network, Unit};
use esc::Port;
use time::Instant;
use unit_model::{ModelUnit, SlaveView};

use crate::happening::HappeningKind;

/// What the L/A indicator of a port shows.
#[must_use]
pub fn port_condition<U: Unit>(
    units: &Network<U>,
    position: usize,
    port: Port,
    now: Instant,
) -> PortCondition {
    let activity = units.segment().port_activity(position, port);
    activity
        .map_or(PortCondition::NoLink, |activity| PortCondition::new(activity.link, activity.is_active(now)))
}

/// Reports the indicators with another pattern than the known one. Without power all of them are dark.
pub(super) fn compare(
    now: Instant,
    position: usize,
    units: &Network<Box<dyn ModelUnit>>,
    known: &mut Vec<Pattern>,
    mut report: impl FnMut(HappeningKind),
) {
    let Some(device) = units.device(position) else { return };
    let unit = device.unit();
    let names = unit.model().indicators();
    // Once for each unit, except after a replacement.
    known.resize(names.len(), Pattern::default());
    let port = |port| port_condition(units, position, port, now);
    let (al_status, al_status_code) = (device.al_status(), device.al_status_code());
    let view = SlaveView { al_status, al_status_code, in_port: port(Port::In), out_port: port(Port::Out) };
    for ((place, name), known) in (0..).zip(names).zip(known) {
        let shown = if device.is_off() { None } else { unit.indicator(name, &view) };
        let pattern = shown.unwrap_or_default();
        if *known != pattern {
            *known = pattern;
            report(HappeningKind::Indicator { place, pattern });
        }
    }
}
