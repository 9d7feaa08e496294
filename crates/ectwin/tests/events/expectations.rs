//! The expected reports of an event to each side, from its row of the event table and the formats of the manual
//! (A-6-4, A-6-7), which are defined here again.

use ectwin::{EventCode, EventLevel, EventLog, Fault};
use nx_ect101::{Event, IoRefreshEffect};

use crate::cases::Case;
use crate::stage::Stage;

pub(crate) struct Expected {
    /// The diagnosis message without its time stamp; none: the history remains empty.
    pub(crate) diagnosis_message: Option<[u8; 24]>,
    pub(crate) access_log: Vec<EventCode>,
    pub(crate) error_status: u8,
    /// Observations and minor faults.
    pub(crate) current_errors: [Vec<[u8; 12]>; 2],
    pub(crate) unit_error: bool,
    pub(crate) io_data_active: bool,
}

impl Expected {
    pub(crate) fn of(case: &Case, event: &Event) -> Self {
        let is_current = event.reported_as_current_error;
        let error = current_error(case, event);
        let of = |level| if is_current && event.level == level { vec![error] } else { vec![] };
        let error_status = match (is_current, event.level) {
            (true, EventLevel::Observation) => 0x10,
            (true, EventLevel::MinorFault) => 0x20,
            _ => 0,
        };
        Self {
            diagnosis_message: event.logged.then(|| diagnosis_message(case, event)),
            access_log: if event.event_log == EventLog::Access { vec![event.code] } else { vec![] },
            error_status,
            current_errors: [of(EventLevel::Observation), of(EventLevel::MinorFault)],
            // A broken memory is not a current error, but it is an error for the CPU Unit.
            unit_error: error_status != 0 || Fault::of_event(event.code) == Some(Fault::NonVolatileMemory),
            io_data_active: !matches!(
                event.io_refresh,
                IoRefreshEffect::NotPerformed | IoRefreshEffect::Stops
            ),
        }
    }

    /// The same by SDO: 2002:01, 2003, 2004, 10F3.
    pub(crate) fn compare_by_sdo(&self, stage: &mut Stage, code: &str) {
        assert_eq!(stage.upload(0x2002, 1), [self.error_status], "{code}: 2002:01");
        for (index, errors) in [0x2003, 0x2004].into_iter().zip(&self.current_errors) {
            assert_eq!(stage.upload(index, 0), [errors.len() as u8], "{code}: {index:04X}:00");
            let first = errors.first().copied().unwrap_or_default();
            assert_eq!(stage.upload(index, 1), first, "{code}: {index:04X}:01");
        }
        let count = u8::from(self.diagnosis_message.is_some());
        let newest = if count == 0 { 0 } else { 6 };
        let header = [1, 2, 3, 4].map(|sub| stage.upload(0x10F3, sub)[0]);
        assert_eq!(header, [count, newest, newest, count], "{code}: 10F3:01 to :04");
        let message = stage.upload(0x10F3, 6);
        let wanted = self.diagnosis_message.unwrap_or_default();
        assert_eq!((&message[..8], &message[16..]), (&wanted[..8], &wanted[16..]), "{code}: 10F3:06");
    }
}

fn current_error(case: &Case, event: &Event) -> [u8; 12] {
    let kind: u32 = if case.detail.is_some() { 0x0007_0401 } else { 0x0007_0000 };
    let mut bytes = [0; 12];
    bytes[..4].copy_from_slice(&event.code.0.to_le_bytes());
    bytes[4..8].copy_from_slice(&kind.to_le_bytes());
    bytes[8..].copy_from_slice(&case.detail.unwrap_or(0).to_le_bytes());
    bytes
}

fn diagnosis_message(case: &Case, event: &Event) -> [u8; 24] {
    let mut bytes = [0; 24];
    bytes[..2].copy_from_slice(&0xE800_u16.to_le_bytes());
    bytes[2..4].copy_from_slice(&event.emergency_code.expect("a code").to_le_bytes());
    let level: u16 = match event.level {
        EventLevel::Information => 0x0010,
        EventLevel::Observation => 0x0011,
        EventLevel::MinorFault => 0x0012,
    };
    let pieces = event.attached_information.len();
    bytes[4..6].copy_from_slice(&(level | (pieces.min(2) as u16) << 8).to_le_bytes());
    bytes[6..8].copy_from_slice(&((event.code.0 >> 16) as u16).to_le_bytes());
    match (pieces, case.detail) {
        (1, Some(detail)) => {
            bytes[16..18].copy_from_slice(&0x0007_u16.to_le_bytes());
            bytes[18..22].copy_from_slice(&detail.to_le_bytes());
        }
        (0, None) => {}
        // System information, and communications by the NX bus: all zeros.
        _ => {
            bytes[16..18].copy_from_slice(&0x0006_u16.to_le_bytes());
            bytes[20..22].copy_from_slice(&0x0006_u16.to_le_bytes());
        }
    }
    bytes
}
