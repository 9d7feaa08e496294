//! Faults at work, of units and of frames, and their ends.

use control::messages::{ActiveFault, Refusal};
use scenario::model::{UnitNumber, UnitOrder};
use scenario::words::Spoken;
use time::Instant;

use crate::line::FaultAtWork;
use crate::runtime::Handle;

const ALL: &str = "all";

/// All faults: those of the units first.
pub(super) fn at_work(handle: &Handle) -> Vec<ActiveFault> {
    let units = handle.look_at_line(|line, _| {
        let injected = line.devices().flat_map(|(position, device)| {
            let unit = device.unit();
            let (names, bits) = (unit.model().faults().iter().enumerate(), unit.injected_faults());
            names.filter(move |(bit, _)| bits >> bit & 1 == 1).map(move |(_, name)| (position, *name))
        });
        injected.collect::<Vec<_>>()
    });
    units.into_iter().map(of_unit).chain(handle.faults().into_iter().map(of_frames)).collect()
}

fn of_unit((position, fault): (usize, &str)) -> ActiveFault {
    let units = UnitNumber::at(position).into();
    let sentence = UnitOrder::InjectFault { units, fault: fault.to_owned() }.sentence();
    ActiveFault {
        clear: Some(format!("{fault} of unit {}", position + 1)),
        sentence,
        unit: Some(position + 1),
        ends_at_ns: None,
        frames_seen: None,
        frames_met: None,
    }
}

fn of_frames(fault: FaultAtWork) -> ActiveFault {
    ActiveFault {
        clear: fault.disturbance.name.map(|name| name.to_string()),
        sentence: fault.sentence,
        unit: None,
        ends_at_ns: (fault.until != Instant::NEVER).then(|| fault.until.as_nanos()),
        frames_seen: Some(fault.frames_seen),
        frames_met: Some(fault.frames_met),
    }
}

/// The orders that end a fault, or all of them.
pub(super) fn sentences_that_end(name: &str, faults: &[ActiveFault]) -> Result<Vec<String>, Refusal> {
    let of_unit = |fault: &&ActiveFault| fault.unit.is_some();
    let name_of = |fault: &ActiveFault| fault.clear.clone().unwrap_or_default();
    if name == ALL {
        let repairs = faults.iter().filter(of_unit).map(|fault| format!("repair {}", name_of(fault)));
        let quiet = faults.iter().any(|fault| fault.unit.is_none()).then(|| "be quiet".to_owned());
        return Ok(repairs.chain(quiet).collect());
    }
    match faults.iter().find(|fault| fault.clear.as_deref() == Some(name)) {
        Some(fault) if fault.unit.is_some() => Ok(vec![format!("repair {name}")]),
        Some(_) => Ok(vec![format!("end {name}")]),
        None => {
            let names: Vec<String> = faults.iter().filter_map(|fault| fault.clear.clone()).collect();
            let names: Vec<&str> = names.iter().map(String::as_str).chain([ALL]).collect();
            Err(Refusal::unknown("fault at work with the name", name, &names))
        }
    }
}
