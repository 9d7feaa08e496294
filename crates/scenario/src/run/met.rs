//! What runs have met, and what there is to meet: states, transitions, codes, events, registers and rules, from the tables
//! of the standard and of the models.

use core::fmt;
use std::collections::BTreeSet;

use device::TRANSITIONS;
use esc::REGISTERS;
use unit_model::{EventCode, Model, PowerOn, UnitSection};
use wire::{AlState, AlStatus, AlStatusCode, Command, SdoAbort, datagrams};

use super::scenario::Scenario;
use super::stack_codes::al_status_codes;
use crate::model::StateName;

/// Something that a run can meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Fact {
    /// A state, by its number in AL status, with or without the error indication.
    State(u16, bool),
    /// A transition from one state to another, by its letters.
    Transition(&'static str),
    /// An AL status code, shown with the error indication.
    AlStatusCode(u16),
    /// An event, recorded by a unit.
    Event(u32),
    /// The abort code of a refused SDO.
    AbortCode(u32),
    /// A register, or a bank of them, by the offset of its first byte: a frame has addressed it.
    Register(u16),
    /// A setting rule of a model, by its name: one of its events is recorded.
    Rule(&'static str),
}

/// A kind of facts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[expect(missing_docs, reason = "they are those of the facts")]
pub enum FactKind {
    State,
    Transition,
    AlStatusCode,
    Event,
    AbortCode,
    Register,
    Rule,
}

impl FactKind {
    /// All of them, in the order in which they are shown.
    pub const ALL: [Self; 7] = [
        Self::State,
        Self::Transition,
        Self::AlStatusCode,
        Self::Event,
        Self::AbortCode,
        Self::Register,
        Self::Rule,
    ];

    /// Its name for people and programs, of one and of several.
    #[must_use]
    pub const fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::State => ("state", "states"),
            Self::Transition => ("transition", "transitions"),
            Self::AlStatusCode => ("AL status code", "AL status codes"),
            Self::Event => ("event", "events"),
            Self::AbortCode => ("abort code", "abort codes"),
            Self::Register => ("register", "registers"),
            Self::Rule => ("rule", "rules"),
        }
    }
}

impl Fact {
    /// Its kind.
    #[must_use]
    pub const fn kind(self) -> FactKind {
        match self {
            Self::State(..) => FactKind::State,
            Self::Transition(_) => FactKind::Transition,
            Self::AlStatusCode(_) => FactKind::AlStatusCode,
            Self::Event(_) => FactKind::Event,
            Self::AbortCode(_) => FactKind::AbortCode,
            Self::Register(_) => FactKind::Register,
            Self::Rule(_) => FactKind::Rule,
        }
    }

    /// Its name in the tables; none if it has only a code.
    #[must_use]
    pub fn name(self) -> Option<&'static str> {
        match self {
            Self::State(..) | Self::Transition(_) | Self::Rule(_) => None,
            Self::AlStatusCode(code) => AlStatusCode(code).row().map(|row| row.meaning),
            Self::Event(code) => plant::event(EventCode(code)).map(|event| event.name),
            Self::AbortCode(code) => SdoAbort(code).row().map(|row| row.meaning),
            Self::Register(offset) => {
                REGISTERS.iter().find(|register| register.offset == offset).map(|register| register.name)
            }
        }
    }
}

/// Its code: `SAFE-OP with error`, `PS`, `0x001B`, `85000000`.
impl fmt::Display for Fact {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::State(bits, error) => {
                StateName(AlState::from_bits(bits)).fmt(formatter)?;
                formatter.write_str(if error { " with error" } else { "" })
            }
            Self::Transition(letters) => formatter.write_str(letters),
            Self::AlStatusCode(code) | Self::Register(code) => write!(formatter, "0x{code:04X}"),
            Self::Event(code) => EventCode(code).fmt(formatter),
            Self::AbortCode(code) => write!(formatter, "0x{code:08X}"),
            Self::Rule(id) => formatter.write_str(id),
        }
    }
}

/// Facts, each once, in the order of their kinds.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Met(BTreeSet<Fact>);

impl Met {
    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = Fact> {
        self.0.iter().copied()
    }

    /// Number of facts.
    #[must_use]
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Adds others, and returns how many of them are new.
    pub fn add(&mut self, others: &Self) -> usize {
        let before = self.0.len();
        self.0.extend(&others.0);
        self.0.len() - before
    }

    /// Whether it has this one.
    #[must_use]
    pub fn has(&self, fact: Fact) -> bool {
        self.0.contains(&fact)
    }

    /// Everything that the units of a scenario could meet: by the tables of the standard and of their models, and by what
    /// their slave stack checks. An AL status code that only a step makes a unit show is not in it.
    #[must_use]
    pub fn possible(scenario: &Scenario) -> Self {
        let mut all = Self::default();
        for unit in &scenario.units {
            all.possible_of(unit.file.section());
        }
        all
    }

    fn possible_of(&mut self, unit: &dyn UnitSection) {
        let has_boot = unit.shape().boot;
        let states = AlState::ALL.into_iter().filter(|state| has_boot || *state != AlState::Boot);
        self.0.extend(states.flat_map(|state| [false, true].map(|error| Fact::State(state.bits(), error))));
        // A request for the present state changes nothing that is seen.
        let rows = TRANSITIONS.iter().filter(|row| row.from != row.to && (has_boot || !row.needs_boot()));
        self.0.extend(rows.map(|row| Fact::Transition(row.letters)));
        let of_stack = al_status_codes(&unit.power_on(&PowerOn::default()).config);
        self.0.extend(of_stack.into_iter().map(|code| Fact::AlStatusCode(code.0)));
        self.0.extend(REGISTERS.iter().map(|register| Fact::Register(register.offset)));
        if unit.shape().mailbox {
            self.0.extend(SdoAbort::TABLE.iter().map(|row| Fact::AbortCode(row.code.0)));
        }
        let tables = unit.model().tables();
        let of_vendor = tables.al_status_codes.iter().map(|row| row.code);
        let of_events = tables.events.iter().filter_map(|row| row.al_status_code);
        let of_notes = tables.al_status_notes.iter().map(|row| row.code);
        let of_model = of_vendor.chain(of_events).chain(of_notes).filter(|code| code.0 != 0);
        self.0.extend(of_model.map(|code| Fact::AlStatusCode(code.0)));
        self.0.extend(tables.events.iter().map(|row| Fact::Event(row.code.0)));
        self.0.extend(tables.rules.iter().map(|row| Fact::Rule(row.id)));
    }

    /// Units begin in INIT.
    pub(super) fn begins(&mut self) {
        self.0.insert(Fact::State(AlState::Init.bits(), false));
    }

    /// A unit shows another state or another code.
    pub(super) fn status(&mut self, before: AlStatus, status: AlStatus, code: AlStatusCode) {
        self.0.insert(Fact::State(status.state.bits(), status.error));
        if before.state != status.state {
            let row = device::transition(before.state, status.state);
            self.0.extend(row.map(|row| Fact::Transition(row.letters)));
        }
        if status.error && code.0 != 0 {
            self.0.insert(Fact::AlStatusCode(code.0));
        }
    }

    /// A unit of this model records an event.
    pub(super) fn event(&mut self, model: &dyn Model, event: EventCode) {
        self.0.insert(Fact::Event(event.0));
        let rules = &model.tables().rules;
        let broken = rules.iter().filter(|rule| rule.events.iter().any(|raised| raised.code == event));
        self.0.extend(broken.map(|rule| Fact::Rule(rule.id)));
    }

    /// An SDO is refused.
    pub(super) fn refusal(&mut self, abort_code: u32) {
        self.0.insert(Fact::AbortCode(abort_code));
    }

    /// A frame addresses registers.
    pub(super) fn frame(&mut self, frame: &[u8]) {
        for datagram in datagrams(frame) {
            let header = datagram.header;
            if is_physical(header.command) {
                let start = usize::from(header.offset);
                let addressed = start..start + usize::from(header.length_bytes);
                let rows = REGISTERS.iter().filter(|register| {
                    let first = usize::from(register.offset);
                    let length = usize::from(register.stride_bytes) * usize::from(register.count.max(1) - 1)
                        + usize::from(register.size_bytes);
                    first < addressed.end && addressed.start < first + length
                });
                self.0.extend(rows.map(|register| Fact::Register(register.offset)));
            }
        }
    }
}

/// Whether the command addresses the memory of slaves, and not the logical memory.
const fn is_physical(command: Command) -> bool {
    match command {
        Command::Nop | Command::Lrd | Command::Lwr | Command::Lrw | Command::Other(_) => false,
        Command::Aprd
        | Command::Apwr
        | Command::Aprw
        | Command::Fprd
        | Command::Fpwr
        | Command::Fprw
        | Command::Brd
        | Command::Bwr
        | Command::Brw
        | Command::Armw
        | Command::Frmw => true,
    }
}

#[cfg(test)]
mod tests {
    use wire::FrameBuilder;

    use super::*;

    #[test]
    fn a_frame_meets_the_registers_that_it_addresses_also_in_the_middle_of_a_bank() {
        let mut met = Met::default();
        let builder = FrameBuilder::new().physical(Command::Fprd, 0x1001, 0x0130, &[0; 6]);
        let builder = builder.physical(Command::Lrd, 0x0120, 0x0120, &[0; 2]);
        met.frame(&builder.physical(Command::Fpwr, 0x1001, 0x0815, &[0; 1]).finish());
        let codes: Vec<String> = met.iter().map(|fact| fact.to_string()).collect();
        assert!(["0x0130", "0x0134"].iter().all(|code| codes.iter().any(|known| known == code)), "{codes:?}");
        assert!(codes.iter().any(|code| code.starts_with("0x08")), "{codes:?}");
        assert!(!codes.iter().any(|code| code == "0x0120"), "{codes:?}");
    }

    #[test]
    fn every_fact_has_its_words() {
        let words =
            |fact: Fact| format!("{} {fact}: {}", fact.kind().words().0, fact.name().unwrap_or_default());
        assert_eq!(words(Fact::State(4, true)), "state SAFE-OP with error: ");
        assert_eq!(words(Fact::Transition("PS")), "transition PS: ");
        assert_eq!(words(Fact::AlStatusCode(0x001B)), "AL status code 0x001B: SyncManager watchdog");
        assert_eq!(words(Fact::Event(0x8500_0000)), "event 85000000: Process Data WDT Error");
        assert!(words(Fact::AbortCode(0x0609_0030)).starts_with("abort code 0x06090030: "));
        assert!(words(Fact::Register(0x0120)).starts_with("register 0x0120: AL"));
    }
}
