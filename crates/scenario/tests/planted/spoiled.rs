//! A unit model whose units are those of another model with one planted bug each. It has the name of the other model, and is
//! given to a scenario in its place: no product contains a bug or a switch for it.

use std::sync::Arc;

use coe_kit::indicators::Pattern;
use device::{Action, Check, Exchange, SmIndex, Start, SyncMode, Unit};
use esi::{DeviceDescription, NamedBit};
use objects::{ObjectServer, ObjectTable};
use time::{Duration, Instant};
use unit_model::{
    CurrentError, DataValid, EventCode, EventInfo, EventLevel, EventLog, Model, ModelTables, ModelUnit,
    NotThere, PowerOn, PoweredUnit, RecordedEvent, SlaveView, UnitFiles, UnitSection,
};
use user_file::{Reader, Section};
use variables::VariableTable;
use wire::{AlState, AlStatusCode, ObjectIndex, SdoAbort, SubIndex};

/// What a bug changes. Everything that it leaves out is right.
pub(crate) trait Bug: core::fmt::Debug + Send {
    fn restarts(&mut self, _now: Instant, _start: Start) {}
    fn al_error(&mut self, _code: AlStatusCode) {}
    fn check_transition(&mut self, _check: Check) -> Result<(), AlStatusCode> {
        Ok(())
    }
    /// The outputs that the unit gets in place of these.
    fn outputs<'a>(&'a mut self, _now: Instant, outputs: Option<&'a [u8]>) -> Option<&'a [u8]> {
        outputs
    }
    /// The inputs of the unit, and whether port IN has a link.
    fn inputs(&mut self, _inputs: &mut [u8], _has_link: bool) {}
    /// A value that was read; `count` is the number of messages in the diagnosis history.
    fn read(&mut self, _entry: (u16, u8), _value: &mut [u8], _count: u8) {}
    fn wrote(&mut self, _entry: (u16, u8), _value: &[u8], _result: Result<(), SdoAbort>) {}
    fn action(&mut self, action: Option<Action>) -> Option<Action> {
        action
    }
    fn event(&mut self, event: EventCode) -> EventCode {
        event
    }
    fn fault(&mut self, _name: &str, _is_present: bool) {}
    fn hides_errors(&self) -> bool {
        false
    }
}

/// The model.
#[derive(Debug)]
pub(crate) struct SpoiledModel {
    pub(crate) make: fn() -> Box<dyn Bug>,
}

fn right() -> &'static dyn UnitFiles {
    plant::models()[0]
}

impl Model for SpoiledModel {
    fn name(&self) -> &'static str {
        right().name()
    }
    fn event(&self, code: EventCode) -> Option<EventInfo> {
        right().event(code)
    }
    fn faults(&self) -> &'static [&'static str] {
        right().faults()
    }
    fn is_fault_of_operation(&self, fault: &str) -> bool {
        right().is_fault_of_operation(fault)
    }
    fn indicators(&self) -> &'static [&'static str] {
        right().indicators()
    }
    fn switches(&self) -> &'static [&'static str] {
        right().switches()
    }
    fn tables(&self) -> &'static ModelTables {
        right().tables()
    }
}

impl UnitFiles for SpoiledModel {
    fn keys(&self) -> Vec<&'static str> {
        right().keys()
    }
    fn read(&self, reader: &mut Reader<'_>, file: &Section<'_, '_>) -> Option<Arc<dyn UnitSection>> {
        let section = right().read(reader, file)?;
        Some(Arc::new(SpoiledFile { section, make: self.make }))
    }
}

#[derive(Debug)]
struct SpoiledFile {
    section: Arc<dyn UnitSection>,
    make: fn() -> Box<dyn Bug>,
}

impl UnitSection for SpoiledFile {
    fn model(&self) -> &'static dyn Model {
        self.section.model()
    }
    fn name(&self) -> &str {
        self.section.name()
    }
    fn node_address(&self) -> u16 {
        self.section.node_address()
    }
    fn description(&self) -> DeviceDescription {
        self.section.description()
    }
    fn objects(&self) -> Arc<ObjectTable> {
        self.section.objects()
    }
    fn named_bits(&self) -> &'static [NamedBit] {
        self.section.named_bits()
    }
    fn variables(&self) -> VariableTable {
        self.section.variables()
    }
    fn refresh_period(&self) -> Option<Duration> {
        self.section.refresh_period()
    }
    fn power_on(&self, conditions: &PowerOn) -> PoweredUnit {
        let PoweredUnit { config, unit, cpu } = self.section.power_on(conditions);
        let unit = Spoiled { unit, table: self.section.objects(), bug: (self.make)() };
        PoweredUnit { config, unit: Box::new(unit), cpu }
    }
}

/// A unit with its bug.
#[derive(Debug)]
struct Spoiled {
    unit: Box<dyn ModelUnit>,
    table: Arc<ObjectTable>,
    bug: Box<dyn Bug>,
}

impl ObjectServer for Spoiled {
    fn table(&self) -> &ObjectTable {
        &self.table
    }
    fn read(&mut self, index: ObjectIndex, sub: SubIndex, value: &mut [u8]) -> Result<(), SdoAbort> {
        let Some(objects) = self.unit.objects() else { return Err(SdoAbort::OBJECT_DOES_NOT_EXIST) };
        let mut count = [0];
        objects.read(ObjectIndex(0x10F3), SubIndex(1), &mut count)?;
        objects.read(index, sub, value)?;
        self.bug.read((index.0, sub.0), value, count[0]);
        Ok(())
    }
    fn write(&mut self, index: ObjectIndex, sub: SubIndex, value: &[u8]) -> Result<(), SdoAbort> {
        let Some(objects) = self.unit.objects() else { return Err(SdoAbort::OBJECT_DOES_NOT_EXIST) };
        let result = objects.write(index, sub, value);
        self.bug.wrote((index.0, sub.0), value, result);
        result
    }
}

impl Unit for Spoiled {
    fn objects(&mut self) -> Option<&mut dyn ObjectServer> {
        // It looks for the CPU Unit first.
        let _ = self.unit.objects();
        Some(self)
    }
    fn mapped_bytes(&self, sync_manager: SmIndex) -> u16 {
        self.unit.mapped_bytes(sync_manager)
    }
    fn sync_mode(&self) -> Option<SyncMode> {
        self.unit.sync_mode()
    }
    fn check_transition(
        &mut self,
        now: Instant,
        check: Check,
        found: &[AlStatusCode],
    ) -> Result<(), AlStatusCode> {
        self.unit.check_transition(now, check, found)?;
        self.bug.check_transition(check)
    }
    fn al_error(&mut self, now: Instant, code: AlStatusCode) -> AlStatusCode {
        self.bug.al_error(code);
        self.unit.al_error(now, code)
    }
    fn entered(&mut self, now: Instant, state: AlState) {
        self.unit.entered(now, state);
    }
    fn refresh_period(&self) -> Option<Duration> {
        self.unit.refresh_period()
    }
    fn refresh(&mut self, now: Instant, exchange: Exchange<'_>) {
        let Exchange { cause, state, links, outputs, inputs } = exchange;
        let outputs = self.bug.outputs(now, outputs);
        self.unit.refresh(now, Exchange { cause, state, links, outputs, inputs: &mut *inputs });
        self.bug.inputs(inputs, links.in_port);
    }
    fn take_action(&mut self) -> Option<Action> {
        self.bug.action(self.unit.take_action())
    }
    fn explicit_device_id(&self) -> Option<u16> {
        self.unit.explicit_device_id()
    }
    fn emergencies_lost(&self) -> u64 {
        self.unit.emergencies_lost()
    }
    fn restart(&mut self, now: Instant, start: Start, sii_image: &mut [u8]) -> Option<AlStatusCode> {
        self.bug.restarts(now, start);
        self.unit.restart(now, start, sii_image)
    }
    fn initializing(&mut self, now: Instant) {
        self.unit.initializing(now);
    }
    fn power_off(&mut self, now: Instant) {
        self.unit.power_off(now);
    }
}

impl ModelUnit for Spoiled {
    fn model(&self) -> &'static dyn Model {
        self.unit.model()
    }
    fn data_valid(&self) -> DataValid {
        self.unit.data_valid()
    }
    fn take_event(&mut self) -> Option<RecordedEvent> {
        let event = self.unit.take_event()?;
        Some(RecordedEvent { code: self.bug.event(event.code), ..event })
    }
    fn injected_faults(&self) -> u32 {
        self.unit.injected_faults()
    }
    fn current_errors(&self, level: EventLevel) -> &[CurrentError] {
        if self.bug.hides_errors() { &[] } else { self.unit.current_errors(level) }
    }
    fn error_status(&self) -> u8 {
        if self.bug.hides_errors() { 0 } else { self.unit.error_status() }
    }
    fn has_new_messages(&self) -> bool {
        self.unit.has_new_messages()
    }
    fn reset_errors(&mut self) {
        self.unit.reset_errors();
    }
    fn clear_event_log(&mut self, log: EventLog) {
        self.unit.clear_event_log(log);
    }
    fn inject(&mut self, fault: &str) -> Result<(), NotThere> {
        self.bug.fault(fault, true);
        self.unit.inject(fault)
    }
    fn remove(&mut self, fault: &str) -> Result<(), NotThere> {
        self.bug.fault(fault, false);
        self.unit.remove(fault)
    }
    fn set_switch(&mut self, switch: &str, position: u16) -> Result<(), NotThere> {
        self.unit.set_switch(switch, position)
    }
    fn indicator(&self, name: &str, slave: &SlaveView) -> Option<Pattern> {
        self.unit.indicator(name, slave)
    }
    fn take_memory_change(&mut self, sii_image: &[u8], sii_words_written: u32) -> bool {
        self.unit.take_memory_change(sii_image, sii_words_written)
    }
    fn encode_memory(&self, bytes: &mut Vec<u8>) {
        self.unit.encode_memory(bytes);
    }
}
