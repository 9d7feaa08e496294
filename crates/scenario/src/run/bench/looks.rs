//! The values that conditions check.

use std::collections::BTreeMap;

use coe_kit::indicators::{Pattern, PortCondition};
use device::{Device, Unit};
use esc::Port;
use plc::Io;
use unit_model::{EventCode, EventLevel, ModelUnit, SlaveView};
use wire::{AlStatus, AlStatusCode, DataType, ObjectIndex, SdoAbort, SubIndex};

use super::Bench;
use crate::model::{IndicatorName, MasterAct, StateName};
use crate::run::ledger::{Ledger, emergency_code};
use crate::run::master::Master;
use crate::run::recorded::Recorded;
use crate::run::witness::{Done, Exchange};

/// The two levels of current errors, the more severe first.
const CURRENT: [EventLevel; 2] = [EventLevel::MinorFault, EventLevel::Observation];

impl Bench<'_> {
    /// Number of units.
    pub(crate) fn count(&self) -> usize {
        self.network.len()
    }

    /// The scripted master; none if other masters use the line.
    pub(crate) fn master(&self) -> Option<&Master> {
        self.masters.map(|masters| masters.scripted)
    }

    /// The recorded master; none if other masters use the line.
    pub(crate) fn recorded_master(&self) -> Option<&Recorded> {
        self.masters.map(|masters| masters.recorded)
    }

    /// The unit at a position that was checked when the scenario was read.
    pub(crate) fn unit(&self, at: usize) -> &dyn ModelUnit {
        &**self.device(at).unit()
    }

    fn device(&self, at: usize) -> &Device<Box<dyn ModelUnit>> {
        match self.network.device(at) {
            Some(device) => device,
            None => panic!("the scenario names unit {}, and was checked", at + 1),
        }
    }

    pub(crate) fn is_off(&self, at: usize) -> bool {
        self.device(at).is_off()
    }

    pub(crate) fn io(&self, at: usize) -> &Io {
        match self.cpus.get(at) {
            Some(cpu) => cpu.io(),
            None => panic!("the scenario names unit {}, and was checked", at + 1),
        }
    }

    pub(crate) fn al_status(&self, at: usize) -> (AlStatus, AlStatusCode) {
        (self.device(at).al_status(), self.device(at).al_status_code())
    }

    pub(crate) fn state_words(&self, at: usize) -> String {
        let (status, code) = self.al_status(at);
        state_words(status, code)
    }

    pub(crate) fn recorded(&self, at: usize) -> &[EventCode] {
        self.records[at].events()
    }

    /// How often a unit has recorded an event.
    pub(crate) fn recorded_times(&self, at: usize, event: EventCode) -> u64 {
        self.records[at].times(event)
    }

    /// Whether a unit has recorded an event since the last mark.
    pub(crate) fn has_recorded_again(&self, at: usize, event: EventCode) -> bool {
        self.records[at].has_again(event)
    }

    /// The diagnosis history as the recorded events say.
    pub(crate) fn ledger_mut(&mut self, at: usize) -> &mut Ledger {
        let model = self.unit(at).model();
        self.records[at].ledger(model)
    }

    /// The emergency error codes that the master has received from a unit, each with its number.
    pub(crate) fn received_codes(&self, at: usize) -> BTreeMap<u16, usize> {
        let mut codes = BTreeMap::new();
        let received = self.master().map(Master::emergencies).unwrap_or_default();
        for received in received.iter().filter(|received| received.unit == at) {
            *codes.entry(received.emergency.code).or_default() += 1;
        }
        codes
    }

    /// Number of recorded events with this emergency error code.
    pub(crate) fn recorded_with(&self, at: usize, code: u16) -> usize {
        let model = self.unit(at).model();
        self.recorded(at).iter().filter(|event| emergency_code(model, **event) == Some(code)).count()
    }

    pub(crate) fn recorded_words(&self, at: usize) -> String {
        let recorded = self.recorded(at);
        if recorded.is_empty() {
            "nothing is recorded".to_owned()
        } else {
            format!("recorded: {}", codes(recorded))
        }
    }

    pub(crate) fn current_errors(&self, at: usize) -> Vec<EventCode> {
        let unit = self.unit(at);
        CURRENT.iter().flat_map(|&level| unit.current_errors(level)).map(|error| error.event).collect()
    }

    pub(crate) fn current_error_words(&self, at: usize) -> String {
        let errors = self.current_errors(at);
        if errors.is_empty() { "no error".to_owned() } else { codes(&errors) }
    }

    /// The bytes of an entry of an object, read from the side of the unit.
    ///
    /// # Errors
    /// The unit does not have it, or refuses to read it.
    pub fn object(&mut self, at: usize, index: ObjectIndex, sub: SubIndex) -> Result<Vec<u8>, SdoAbort> {
        let missing = SdoAbort::OBJECT_DOES_NOT_EXIST;
        let objects =
            self.network.device_mut(at).and_then(|device| device.unit_mut().objects()).ok_or(missing)?;
        let entry = objects.table().entry(index, sub).ok_or(missing)?;
        let mut value = vec![0; entry.size_bytes()];
        objects.read(index, sub, &mut value).map(|()| value)
    }

    /// The data type of an entry; none if the unit does not have it.
    pub fn object_type(&mut self, at: usize, index: ObjectIndex, sub: SubIndex) -> Option<DataType> {
        let objects = self.network.device_mut(at).and_then(|device| device.unit_mut().objects())?;
        objects.table().entry(index, sub).map(|entry| entry.data_type)
    }

    pub(crate) fn registers(&self, at: usize, offset: u16, length_bytes: usize) -> Vec<u8> {
        let mut bytes = vec![0; length_bytes];
        if let Some(esc) = self.network.esc(at) {
            esc.look(offset, &mut bytes, self.now);
        }
        bytes
    }

    /// Number of emergencies for which a unit had no mailbox, or no room in it.
    pub(crate) fn emergencies_lost(&self, at: usize) -> u64 {
        self.device(at).emergencies_lost()
    }

    pub(crate) fn inputs(&self, at: usize) -> &[u8] {
        self.master().map(|master| master.inputs(at)).unwrap_or_default()
    }

    pub(crate) fn working_counter(&self, at: usize) -> Option<u16> {
        match self.master() {
            Some(master) => master.working_counter(at),
            None => self.exchange(at)?.working_counter,
        }
    }

    /// The process data of a unit as they come; none: nobody has asked for them before.
    pub(crate) fn exchange(&self, at: usize) -> Option<&Exchange> {
        self.witness.exchange(at)
    }

    /// How often the master has done something; none: nobody has asked for it before.
    pub(crate) fn done(&self, act: &MasterAct) -> Option<&Done> {
        self.witness.done(act)
    }

    /// The pattern of an indicator; none if the unit has no indicator with this name.
    pub(crate) fn indicator(&self, at: usize, name: IndicatorName) -> Option<Pattern> {
        self.pattern(at, name.as_str())
    }

    /// The same by the name in the model.
    pub(crate) fn pattern(&self, at: usize, name: &str) -> Option<Pattern> {
        if self.is_off(at) {
            return self.unit(at).model().indicators().contains(&name).then_some(Pattern::NotLit);
        }
        let (al_status, al_status_code) = self.al_status(at);
        let [in_port, out_port] = [Port::In, Port::Out].map(|port| self.port(at, port));
        self.unit(at).indicator(name, &SlaveView { al_status, al_status_code, in_port, out_port })
    }

    fn port(&self, at: usize, port: Port) -> PortCondition {
        plant::port_condition(self.network, at, port, self.now)
    }
}

pub(crate) fn state_words(status: AlStatus, code: AlStatusCode) -> String {
    let state = StateName(status.state);
    if status.error { format!("{state} with AL status code {:#06X}", code.0) } else { state.to_string() }
}

fn codes(codes: &[EventCode]) -> String {
    codes.iter().map(EventCode::to_string).collect::<Vec<_>>().join(", ")
}
