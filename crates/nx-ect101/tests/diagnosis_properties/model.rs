//! A unit's diagnosis as in the manual (8-3 to 8-6, A-6-4, A-6-7), in plain lists.

mod requests;

use std::collections::BTreeSet;

use device::Start;
use nx_ect101::Fault;
use wire::AlState;

use crate::log::{ACCESS, HISTORY, Log, Record};
use crate::rows::{self, FAULTS, Found, MINOR_FAULT, OBSERVATION};
use crate::settings::{IoSetting, PdoSetting, Told};

/// Current errors, observations and minor faults together (8-3-2).
pub(crate) const CURRENT: usize = 10;
/// Maximum number of waiting emergency messages.
pub(crate) const WAITING: usize = 16;

/// Situations that random sequences must reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Situation {
    Event(u32),
    HistoryWrapped,
    MinorFaultTookPlace,
    EleventhMinorFault,
    ObservationWithoutRoom,
    ObservationBesideOthersWithoutRoom,
    AccessLogFull,
    EmergencyLost,
    OlderAcknowledged,
    EmptySlotAcknowledged,
    RecordedWhileMemoryBroken,
    OneOfTwoIoCausesGone,
    IoCauseCameAgain,
    CauseGoneBeforeReset,
}

/// A current error.
#[derive(Clone, Debug)]
pub(crate) struct Error {
    pub(crate) level: u16,
    event: u32,
    detail: Option<u32>,
}

impl Error {
    /// The twelve bytes in objects 2003 and 2004.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let kind = if self.detail.is_some() { [1, 4, 7, 0] } else { [0, 0, 7, 0] };
        [self.event.to_le_bytes(), kind, self.detail.unwrap_or(0).to_le_bytes()].concat()
    }
}

/// The unit, for its events.
#[derive(Debug)]
pub(crate) struct Model {
    pub(crate) log: Log,
    /// The memory as last stored.
    pub(crate) stored: Log,
    log_changed: bool,
    /// In the order in which they occurred.
    pub(crate) errors: Vec<Error>,
    pub(crate) error_status: u8,
    /// Wrong settings and mismatches that persist.
    standing: Vec<(u32, Vec<u32>)>,
    /// Causes by injection.
    injected: BTreeSet<Fault>,
    /// The bytes of the memory could not be read at power-on.
    memory_damaged: bool,
    /// The controller could not load the SII.
    sii_not_loaded: bool,
    /// The CPU Unit did refresh I/O and no longer does.
    cpu_stopped: bool,
    cpu_refreshing: bool,
    found: BTreeSet<Fault>,
    /// The findings of the start, which the first refresh will report.
    untold: BTreeSet<Fault>,
    is_starting: bool,
    pub(crate) emergencies: Vec<[u8; 8]>,
    pub(crate) emergencies_lost: u64,
    pub(crate) emergencies_enabled: bool,
    pub(crate) last_acknowledged: u8,
    /// Mismatch levels as set, and as effective since the start.
    set_levels: Vec<(u32, u16)>,
    levels: Vec<(u32, u16)>,
    time_ns: u64,
    pub(crate) state: AlState,
    io: IoSetting,
    /// The mapping with which the unit entered SAFE-OP.
    pub(crate) mapped: PdoSetting,
    pub(crate) seen: BTreeSet<Situation>,
}

impl Model {
    /// The first power-on; the user has set these events to observation.
    pub(crate) fn power_on(io: IoSetting, mapped: PdoSetting, observations: &[u32]) -> Self {
        let levels: Vec<_> = observations.iter().map(|&event| (event, OBSERVATION)).collect();
        Self {
            log: Log::default(),
            stored: Log::default(),
            log_changed: false,
            errors: Vec::new(),
            error_status: 0,
            standing: Vec::new(),
            injected: BTreeSet::new(),
            memory_damaged: false,
            sii_not_loaded: false,
            cpu_stopped: false,
            cpu_refreshing: false,
            found: BTreeSet::new(),
            untold: BTreeSet::new(),
            is_starting: true,
            emergencies: Vec::new(),
            emergencies_lost: 0,
            emergencies_enabled: false,
            last_acknowledged: 0,
            set_levels: levels.clone(),
            levels,
            time_ns: 0,
            state: AlState::Init,
            io,
            mapped,
            seen: BTreeSet::new(),
        }
    }

    /// A power cycle. Only the stored data are kept, if they can be read.
    pub(crate) fn cycle_power(&mut self, damaged: bool) {
        self.log = if damaged { Log::default() } else { self.stored.clone() };
        // A new memory must be stored as soon as the hardware works.
        self.log_changed = damaged;
        self.injected.clear();
        self.memory_damaged = damaged;
        self.sii_not_loaded = false;
        self.time_ns = 0;
        self.emergencies_lost = 0;
        self.start();
    }

    /// The unit is restarted, with or without a power cycle; or only its controller is reset.
    pub(crate) fn restart(&mut self, start: Start) {
        if start == Start::EscReset {
            return self.enter(AlState::Init);
        }
        self.memory_damaged &= start != Start::PowerOn;
        self.sii_not_loaded = false;
        self.start();
        if start == Start::Restart {
            self.occurs(rows::RESTARTED, Vec::new());
        }
    }

    /// The unit starts (8-6): the current errors are cleared, the logs are kept.
    fn start(&mut self) {
        // It watches the CPU Unit from the beginning.
        (self.cpu_stopped, self.cpu_refreshing) = (false, false);
        self.clear_errors();
        self.standing.clear();
        self.emergencies.clear();
        self.emergencies_enabled = false;
        self.last_acknowledged = 0;
        self.levels.clone_from(&self.set_levels);
        self.is_starting = true;
        self.state = AlState::Init;
        let lasting = |row: &&rows::FaultRow| matches!(row.found, Found::AtStart | Found::AtOnce);
        let found = FAULTS.iter().filter(lasting).map(|row| row.fault);
        self.found = found.filter(|&fault| self.is_present(fault)).collect();
        self.untold.clone_from(&self.found);
    }

    /// Whether there is a cause of a fault.
    fn is_present(&self, fault: Fault) -> bool {
        let is_seen = match fault {
            Fault::NonVolatileMemory => self.memory_damaged,
            Fault::SiiVerification => self.sii_not_loaded,
            Fault::IoCommunications => self.cpu_stopped,
            _ => false,
        };
        is_seen || self.injected.contains(&fault)
    }

    /// The stored memory follows the log. Changes while the memory is broken are stored with the first change
    /// after that.
    pub(crate) fn store(&mut self) {
        let broken = self.found.contains(&Fault::NonVolatileMemory);
        if self.log_changed && broken {
            self.seen.insert(Situation::RecordedWhileMemoryBroken);
        } else if self.log_changed {
            self.log_changed = false;
            self.stored = self.log.clone();
        }
    }

    /// NX Unit Error Status: any error, and a broken memory too.
    pub(crate) fn has_error(&self) -> bool {
        self.error_status != 0 || self.found.contains(&Fault::NonVolatileMemory)
    }

    /// The AL status code that keeps the unit in INIT: that of the first fault that has one, else 0.
    pub(crate) fn fault(&self) -> Option<u16> {
        let found = FAULTS.iter().filter(|row| self.found.contains(&row.fault));
        let codes: Vec<u16> = found.filter_map(|row| row.stops_in_init).collect();
        codes.iter().copied().find(|&code| code != 0).or(codes.first().copied())
    }

    /// An event occurs.
    fn occurs(&mut self, event: u32, details: Vec<u32>) {
        self.seen.insert(Situation::Event(event));
        if event == rows::MEMORY_BROKEN {
            return;
        }
        let changed = self.levels.iter().rfind(|changed| changed.0 == event);
        let level = changed.map_or(rows::level(event), |changed| changed.1);
        let record = Record { event, level, time_ns: self.time_ns, details };
        let detail = record.details.first().copied();
        self.log_changed |= rows::emergency_code(event).is_some() || rows::is_access_event(event);
        if rows::is_access_event(event) {
            self.log.access.push(record.clone());
            if self.log.access.len() > ACCESS {
                self.seen.insert(Situation::AccessLogFull);
            }
        }
        if rows::emergency_code(event).is_some() {
            self.log.add(record);
            if self.log.history.len() > HISTORY {
                self.seen.insert(Situation::HistoryWrapped);
            }
        }
        self.exists(Error { level, event, detail });
        self.notify(event);
    }

    fn tell(&mut self, told: &[Told]) {
        for &(event, detail) in told {
            self.occurs(event, detail.into_iter().collect());
        }
    }

    /// Ten errors, the oldest and highest first (8-3-2); the status includes the others too.
    fn exists(&mut self, error: Error) {
        match error.level {
            MINOR_FAULT => self.error_status |= 0x20,
            OBSERVATION => self.error_status |= 0x10,
            _ => return,
        }
        let is_same = |other: &Error| (other.event, other.detail) == (error.event, error.detail);
        if self.errors.iter().any(is_same) {
            return;
        }
        if self.errors.len() == CURRENT {
            let newest_observation = self.errors.iter().rposition(|other| other.level == OBSERVATION);
            let (place, situation) = match (error.level, newest_observation) {
                (OBSERVATION, None) => (None, Situation::ObservationWithoutRoom),
                (OBSERVATION, _) => (None, Situation::ObservationBesideOthersWithoutRoom),
                (_, None) => (None, Situation::EleventhMinorFault),
                (_, place) => (place, Situation::MinorFaultTookPlace),
            };
            self.seen.insert(situation);
            let Some(place) = place else { return };
            self.errors.remove(place);
        }
        self.errors.push(error);
    }

    /// An emergency message, if the master has enabled them and the event has one.
    fn notify(&mut self, event: u32) {
        let Some(code) = rows::emergency_code(event) else { return };
        if !self.emergencies_enabled || !rows::can_be_notified(event) {
            return;
        }
        let ([a, b], [e, f, g, h]) = (code.to_le_bytes(), event.to_le_bytes());
        if self.emergencies.len() < WAITING {
            self.emergencies.push([a, b, 0, 0, e, f, g, h]);
        } else {
            self.emergencies_lost += 1;
            self.seen.insert(Situation::EmergencyLost);
        }
    }

    fn clear_errors(&mut self) {
        self.errors.clear();
        self.error_status = 0;
    }
}
