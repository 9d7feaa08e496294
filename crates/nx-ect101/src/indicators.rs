//! The indicators of the unit: RUN, ERR, L/A IN, L/A OUT and TS (manual, 3-2 and 8-2).
//!
//! The inputs are causes, the outputs are patterns, and a point in time selects the lights: no clock, no state.
//! If there are several causes:
//!
//! | indicator | priority |
//! |---|---|
//! | all | no power: everything is dark; before initialization RUN, ERR and TS are |
//! | RUN | off after a hardware failure, else the EtherCAT state alone |
//! | ERR | hardware failure, ESC error, then the AL status code that the master reads |
//! | L/A | the port alone |
//! | TS | one condition at a time; [`NxCondition::or_worse`] picks it |

mod table;

use coe_kit::indicators::{self, Pattern, PortCondition};
use time::Instant;
use wire::{AlState, AlStatusCode};

use crate::events::{Event, EventCode, IndicatorStatus};
use table::{PrimaryCause, primary};

pub(crate) use table::pattern_sources;
pub use table::{Colour, Indicator, IndicatorMeaning};

/// All inputs of the indicators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IndicatorCauses {
    /// Whether the unit has power.
    pub power: bool,
    /// Its condition as an NX Unit.
    pub nx: NxCondition,
    /// The actual EtherCAT state.
    pub state: AlState,
    /// The AL status code, while AL status indicates an error.
    pub al_error: Option<AlStatusCode>,
    /// Whether ESC Error is present; it has no AL status code.
    pub esc_error: bool,
    /// Port IN.
    pub in_port: PortCondition,
    /// Port OUT.
    pub out_port: PortCondition,
}

/// The condition of the unit as an NX Unit: shown by TS.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum NxCondition {
    /// After power-on or a restart, before initialization begins.
    #[default]
    WaitingForInitialization,
    /// Initialization or download; a restart ends with it.
    Initializing,
    /// Ready for I/O refreshing.
    Normal,
    /// An event is present.
    Error(EventCode),
    /// The CPU Unit has failed.
    CpuUnitMalfunction,
    /// The unit itself is broken.
    HardwareFailure,
}

impl NxCondition {
    /// The condition that TS shows if both apply: the more severe one, in the order from least to most: normal,
    /// events that TS does not show, TS off, initializing, TS flashing red, TS red, waiting for initialization,
    /// hardware failure. If both are equal it is `self`: pass the older one first.
    #[must_use]
    pub fn or_worse(self, other: Self) -> Self {
        if other.severity() > self.severity() { other } else { self }
    }

    fn severity(self) -> u8 {
        match self {
            Self::Normal => 0,
            Self::Error(_) => match self.ts() {
                (_, Pattern::Lit) => 5,
                (_, Pattern::Flashing1s) => 4,
                (Pattern::NotLit, _) => 2,
                _ => 1,
            },
            Self::Initializing => 3,
            Self::CpuUnitMalfunction => 5,
            Self::WaitingForInitialization => 6,
            Self::HardwareFailure => 7,
        }
    }

    /// TS green and red. If the event does not define a column, it is as without the event.
    fn ts(self) -> (Pattern, Pattern) {
        let row = primary(self.primary());
        let event = match self {
            Self::Error(code) => Event::find(code),
            _ => None,
        };
        match event {
            Some(event) => (
                event.ts_green.pattern().unwrap_or(row.ts_green),
                event.ts_red.pattern().unwrap_or(row.ts_red),
            ),
            None => (row.ts_green, row.ts_red),
        }
    }

    const fn primary(self) -> PrimaryCause {
        match self {
            Self::WaitingForInitialization => PrimaryCause::WaitingForInitialization,
            Self::Initializing => PrimaryCause::Initializing,
            Self::Normal | Self::Error(_) => PrimaryCause::Normal,
            Self::CpuUnitMalfunction => PrimaryCause::CpuUnitMalfunction,
            Self::HardwareFailure => PrimaryCause::HardwareFailure,
        }
    }

    /// Whether the application runs, so that RUN and ERR show EtherCAT.
    const fn application_runs(self) -> bool {
        !matches!(self, Self::WaitingForInitialization | Self::HardwareFailure)
    }
}

/// The pattern of each indicator.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Indicators {
    /// RUN, green.
    pub run: Pattern,
    /// ERR, red.
    pub err: Pattern,
    /// L/A IN, green.
    pub la_in: Pattern,
    /// L/A OUT, green.
    pub la_out: Pattern,
    /// TS, green.
    pub ts_green: Pattern,
    /// TS, red; green and red are never lit together.
    pub ts_red: Pattern,
}

/// The lights at one point in time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Lights {
    /// RUN, green.
    pub run: bool,
    /// ERR, red.
    pub err: bool,
    /// L/A IN, green.
    pub la_in: bool,
    /// L/A OUT, green.
    pub la_out: bool,
    /// TS, green.
    pub ts_green: bool,
    /// TS, red.
    pub ts_red: bool,
}

impl Indicators {
    /// No power: all dark.
    pub const DARK: Self = Self {
        run: Pattern::NotLit,
        err: Pattern::NotLit,
        la_in: Pattern::NotLit,
        la_out: Pattern::NotLit,
        ts_green: Pattern::NotLit,
        ts_red: Pattern::NotLit,
    };

    /// The patterns of the indicators for these causes.
    #[must_use]
    pub fn of(causes: &IndicatorCauses) -> Self {
        if !causes.power {
            return Self::DARK;
        }
        let (ts_green, ts_red) = causes.nx.ts();
        let row = primary(causes.nx.primary());
        let (run, err) = if causes.nx.application_runs() {
            (indicators::run(causes.state), err(causes.esc_error, causes.al_error))
        } else {
            (row.run, row.err)
        };
        Self {
            run,
            err,
            la_in: causes.in_port.pattern(),
            la_out: causes.out_port.pattern(),
            ts_green,
            ts_red,
        }
    }

    /// The lights at this time.
    #[must_use]
    pub fn lights(&self, at: Instant) -> Lights {
        Lights {
            run: self.run.is_lit(at),
            err: self.err.is_lit(at),
            la_in: self.la_in.is_lit(at),
            la_out: self.la_out.is_lit(at),
            ts_green: self.ts_green.is_lit(at),
            ts_red: self.ts_red.is_lit(at),
        }
    }

    /// The time of the next change of a light, after `at`, unless a cause changes before; [`Instant::NEVER`] if
    /// all are steady.
    #[must_use]
    pub fn next_change(&self, at: Instant) -> Instant {
        let all = [self.run, self.err, self.la_in, self.la_out, self.ts_green, self.ts_red];
        all.into_iter().map(|pattern| pattern.next_change(at)).min().unwrap_or(Instant::NEVER)
    }
}

/// ERR for the event with the AL status code that the master reads: events with the same code have the same
/// pattern. A code without an event is one of the standard.
fn err(esc_error: bool, al_error: Option<AlStatusCode>) -> Pattern {
    let esc_error = esc_error.then(|| Event::find(Event::ESC_ERROR)).flatten();
    let of_code = |code| Event::all().iter().find(|event| event.al_status_code == Some(code));
    let event = esc_error.or_else(|| al_error.and_then(of_code));
    event.and_then(|event| event.err.pattern()).unwrap_or_else(|| indicators::err(al_error))
}

impl IndicatorStatus {
    /// The pattern of an event; none if the event does not change the indicator.
    #[must_use]
    pub const fn pattern(self) -> Option<Pattern> {
        Some(match self {
            Self::NotLit => Pattern::NotLit,
            Self::Lit => Pattern::Lit,
            Self::Flickering => Pattern::Flickering,
            Self::Blinking => Pattern::Blinking,
            Self::SingleFlash => Pattern::SingleFlash,
            Self::DoubleFlash => Pattern::DoubleFlash,
            Self::Flashing1s => Pattern::Flashing1s,
            Self::Flashing2s => Pattern::Flashing2s,
            Self::Undefined | Self::NotListed => return None,
        })
    }
}
