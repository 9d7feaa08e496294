//! The names of the setting rules, their sides, their times and their events.

use crate::data_sets::Direction;
use crate::events::EventCode;

/// The kind of settings of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    /// I/O entries, which the CPU Unit allocates.
    IoEntry,
    /// PDO entries, which the master maps.
    PdoEntry,
    /// The PDOs that the master assigns to the SyncManagers.
    Assignment,
}

impl Side {
    /// Its name in data for programs.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::IoEntry => "io_entry",
            Self::PdoEntry => "pdo_entry",
            Self::Assignment => "assignment",
        }
    }
}

/// A setting rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RuleId {
    /// The requirements for every PDO setting.
    Mandatory,
    /// Allocation order to the SyncManager.
    SmOrder,
    /// Type of entry.
    Type,
    /// Order of entry.
    Order,
    /// Total amount of data.
    Total,
    /// Combination of data.
    Combination,
    /// Matched amount of data.
    Matched,
}

impl RuleId {
    /// Its name in data for programs.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Mandatory => "mandatory",
            Self::SmOrder => "sm_order",
            Self::Type => "type",
            Self::Order => "order",
            Self::Total => "total",
            Self::Combination => "combination",
            Self::Matched => "matched",
        }
    }
}

/// The time at which a rule is checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Moment {
    /// At power-on of the NX Unit: a violation prevents the start of I/O refreshing, EtherCAT continues.
    PowerOn,
    /// When the master requests SAFE-OP: a violation with an AL status code keeps the unit in PRE-OP.
    PreOpToSafeOp,
}

/// The events of a rule for one side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RuleEvents {
    /// The side.
    pub side: Side,
    /// The time of the check.
    pub moment: Moment,
    /// Event for data from the master to the CPU Unit.
    pub m_to_c: EventCode,
    /// Event for data from the CPU Unit to the master.
    pub c_to_m: EventCode,
}

impl RuleEvents {
    /// The event for data of `direction`.
    #[must_use]
    pub const fn of(&self, direction: Direction) -> EventCode {
        match direction {
            Direction::MToC => self.m_to_c,
            Direction::CToM => self.c_to_m,
        }
    }

    pub(crate) const fn at_power_on(side: Side, m_to_c: u32, c_to_m: u32) -> Self {
        Self { side, moment: Moment::PowerOn, m_to_c: EventCode(m_to_c), c_to_m: EventCode(c_to_m) }
    }

    pub(crate) const fn at_safe_op(side: Side, m_to_c: u32, c_to_m: u32) -> Self {
        Self { side, moment: Moment::PreOpToSafeOp, m_to_c: EventCode(m_to_c), c_to_m: EventCode(c_to_m) }
    }
}
