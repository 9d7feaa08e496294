//! The CPU Unit: a primary periodic task that refreshes the I/O of one unit and runs a user program.

use core::fmt;

use nx_ect101::nx_bus::{CpuEnd, CpuHeader};
use nx_ect101::unit_file::{CpuMode, UnitFile};
use time::{Duration, Instant};

use crate::io::{Io, Program};

/// Operating mode of the CPU Unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OperatingMode {
    /// RUN: the user program runs.
    #[default]
    Run,
    /// PROGRAM: the user program stands; the I/O exchange goes on and the values stay (manual, A-4).
    Program,
}

/// How a CPU Unit is set up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CpuSettings {
    /// Device name of the unit on the NX bus: the first part of its device variables' names.
    pub device_name: String,
    /// NX Unit number of the unit, from 1.
    pub unit_number: u8,
    /// Task period of the primary periodic task; not zero.
    pub task_period: Duration,
    /// Operating mode at power-on.
    pub mode: OperatingMode,
    /// System time at power-on in nanoseconds since 1970-01-01 00:00:00; none: the CPU Unit tells none.
    pub system_time_ns: Option<u64>,
}

impl CpuSettings {
    /// The settings of a unit file, without system time.
    #[must_use]
    pub fn from_unit_file(file: &UnitFile) -> Self {
        let mode = match file.cpu.mode.value {
            CpuMode::Run => OperatingMode::Run,
            CpuMode::Program => OperatingMode::Program,
        };
        Self {
            device_name: file.name.value.clone(),
            unit_number: file.unit_number.value,
            task_period: file.cpu.task_period.value,
            mode,
            system_time_ns: None,
        }
    }
}

impl Default for CpuSettings {
    /// A unit N1 with number 1; 1 ms, RUN, no system time.
    fn default() -> Self {
        Self {
            device_name: "N1".to_owned(),
            unit_number: 1,
            task_period: Duration::from_millis(1),
            mode: OperatingMode::Run,
            system_time_ns: None,
        }
    }
}

/// A CPU Unit in operation, with one unit on its NX bus.
pub struct CpuUnit {
    bus: CpuEnd,
    program: Box<dyn Program + Send>,
    io: Io,
    mode: OperatingMode,
    task_period: Duration,
    powered_on: Instant,
    system_time_ns: Option<u64>,
    io_refreshing: bool,
    deadline: Instant,
}

impl CpuUnit {
    /// Turns a CPU Unit on. Its first task period begins at `now`. All memory that it ever uses is allocated
    /// here.
    ///
    /// # Panics
    /// If the task period is zero: who reads settings refuses it.
    #[must_use]
    pub fn power_on(
        now: Instant,
        settings: CpuSettings,
        bus: CpuEnd,
        program: Box<dyn Program + Send>,
    ) -> Self {
        assert!(!settings.task_period.is_zero(), "the task period is zero");
        Self {
            io: Io::new(
                &settings.device_name,
                settings.unit_number,
                bus.m_to_c_layout.clone(),
                bus.c_to_m_layout.clone(),
            ),
            bus,
            program,
            mode: settings.mode,
            task_period: settings.task_period,
            powered_on: now,
            system_time_ns: settings.system_time_ns,
            io_refreshing: true,
            deadline: now,
        }
    }

    /// When the next task period begins.
    #[must_use]
    pub const fn deadline(&self) -> Instant {
        self.deadline
    }

    /// One task period: first the I/O refresh, which hands over the data C to M that the last scan left and
    /// takes in the newest data M to C, then the user program in RUN mode. So what a program makes of its
    /// inputs goes out one task period later: the 2 T_cpu of the I/O response time (manual, 7-9-1).
    ///
    /// Periods keep their phase; those that were missed by `now` are left out.
    pub fn cycle(&mut self, now: Instant) {
        self.refresh_outputs(now);
        self.refresh_inputs();
        if self.mode == OperatingMode::Run {
            self.program.scan(&mut self.io);
            self.io.memory.c_to_m.apply_forced();
        }
        self.io.nx_objects.send(&mut self.bus.messages);
        let late = now.saturating_since(self.deadline).as_nanos() / self.task_period.as_nanos();
        self.deadline += self.task_period * (late + 1);
    }

    /// The operating mode.
    #[must_use]
    pub const fn mode(&self) -> OperatingMode {
        self.mode
    }

    /// Changes the operating mode, in force from the next task period on.
    pub fn set_mode(&mut self, mode: OperatingMode) {
        self.mode = mode;
    }

    /// Whether the CPU Unit does I/O refreshing on the NX bus, from the next task period on. A CPU Unit that stops
    /// it has an error of its own; the unit tells NX Unit I/O Communications Error (manual, 8-3-4, 80200000).
    pub fn set_io_refreshing(&mut self, io_refreshing: bool) {
        self.io_refreshing = io_refreshing;
    }

    /// Sets the system time ahead; a CPU Unit without system time has none to set.
    pub fn jump_system_time(&mut self, ahead: Duration) {
        self.system_time_ns = self.system_time_ns.map(|time_ns| time_ns.saturating_add(ahead.as_nanos()));
    }

    /// The I/O as the user program sees it.
    #[must_use]
    pub const fn io(&self) -> &Io {
        &self.io
    }

    /// The I/O, to be changed from outside the user program: what is set goes out with the next task period.
    #[must_use]
    pub const fn io_mut(&mut self) -> &mut Io {
        &mut self.io
    }

    fn refresh_inputs(&mut self) {
        // Responses first: then no flag is older than a response.
        self.io.nx_objects.receive(&mut self.bus.messages);
        let image = self.bus.m_to_c.newest();
        self.io.take_inputs(image.header, image.bytes());
    }

    fn refresh_outputs(&mut self, now: Instant) {
        let running_ns = now.saturating_since(self.powered_on).as_nanos();
        let system_time_ns = self.system_time_ns.map_or(0, |start_ns| start_ns.saturating_add(running_ns));
        let header = CpuHeader { refreshing: self.io_refreshing, messages_enabled: true, system_time_ns };
        self.io.memory.c_to_m.apply_forced();
        self.bus.c_to_m.publish(header, self.io.c_to_m());
    }
}

impl fmt::Debug for CpuUnit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut fields = formatter.debug_struct("CpuUnit");
        fields.field("mode", &self.mode).field("task_period", &self.task_period);
        fields.field("deadline", &self.deadline).field("io", &self.io).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
