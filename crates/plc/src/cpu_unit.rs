//! The CPU Unit: a primary periodic task that refreshes the I/O of one unit and runs a user program.

mod operating_mode;
mod settings;

use core::fmt;
use core::sync::atomic::AtomicBool;
use std::sync::Arc;

use nx_bus::{CpuEnd, CpuHeader, NxRequest};
use time::{Duration, Instant};
use wire::{ObjectIndex, SubIndex};

use crate::cpu_event::{CpuEvent, CpuRecord};
use crate::device_variables::DeviceVariables;
use crate::io::Io;
use crate::nx_bus_function::{IoRefreshing, NxBusFunction, NxBusReset};
use crate::observed_events::ObservedEvents;
use crate::program::{Program, Slot};
use crate::reports::Reports;
use crate::scan_watch::ScanWatch;

pub use operating_mode::OperatingMode;
pub use settings::CpuSettings;

/// A CPU Unit in operation, with one unit on its NX bus.
pub struct CpuUnit {
    bus: CpuEnd,
    nx_bus_function: NxBusFunction,
    /// Outside runtimes, in the order of their attachment.
    attached: Vec<Slot>,
    user_program: Slot,
    io: Io,
    mode: OperatingMode,
    mode_at_power_on: OperatingMode,
    /// The task period of the settings, for programs that do not request one.
    own_period: Duration,
    task_period: Duration,
    task_phase: Duration,
    powered_on: Instant,
    system_time_ns: Option<u64>,
    io_refreshing: bool,
    /// Its task does not run without power, and not while it is stopped.
    has_power: bool,
    is_task_stopped: bool,
    reports: Reports,
    /// Number of task periods started. It wraps.
    task_periods: u32,
    deadline: Instant,
}

impl CpuUnit {
    /// Switches a CPU Unit on, whose unit has these variables and the other end of the bus. Its first task period
    /// begins at `now` plus the task's phase. All the memory that it ever uses is allocated here.
    ///
    /// # Panics
    /// If the task period is zero: the code that reads settings refuses it.
    #[must_use]
    pub fn power_on(
        now: Instant,
        settings: CpuSettings,
        variables: DeviceVariables,
        bus: CpuEnd,
        program: Box<dyn Program + Send>,
    ) -> Self {
        assert!(!settings.task_period.is_zero(), "the task period is zero");
        let program_period = program.task_period().filter(|period| !period.is_zero());
        let mut cpu = Self {
            io: Io::new(variables),
            bus,
            nx_bus_function: NxBusFunction::new(settings.fail_soft),
            attached: Vec::new(),
            user_program: Slot::new(program),
            mode: settings.mode,
            mode_at_power_on: settings.mode,
            own_period: settings.task_period,
            task_period: program_period.unwrap_or(settings.task_period),
            task_phase: settings.task_phase,
            powered_on: now,
            system_time_ns: settings.system_time_ns,
            io_refreshing: true,
            has_power: true,
            is_task_stopped: false,
            reports: Reports::default(),
            task_periods: 0,
            deadline: now + settings.task_phase,
        };
        cpu.io.events.power_on(now);
        cpu.announce();
        cpu
    }

    /// Ends a scan in progress when this flag is set, so that a CPU Unit can be switched off in the middle of a
    /// long one.
    pub fn switch_off_on(&mut self, flag: Arc<AtomicBool>) {
        self.io.switch_off = flag;
    }

    /// Lets the owner of this watch end a scan that is under way, so that a program that does not return can be replaced.
    /// The owner tells it when a scan begins and has ended.
    pub fn watch_scans(&mut self, watch: Arc<ScanWatch>) {
        self.io.scan = watch;
    }

    /// When the next task period begins; [`Instant::NEVER`] without power, and while the task is stopped.
    #[must_use]
    pub const fn deadline(&self) -> Instant {
        if self.has_power && !self.is_task_stopped { self.deadline } else { Instant::NEVER }
    }

    /// One task period: first the I/O refresh, which sends the data C to M of the last scan and receives the
    /// newest data M to C, then the outside runtimes, then the user program in RUN mode. So the results of a
    /// program are sent one task period after its inputs were received: the 2 T_cpu of the I/O response time
    /// (manual, 7-9-1).
    ///
    /// Periods keep their phase; those that were missed by `now` are left out, and an event contains their number.
    pub fn cycle(&mut self, now: Instant) {
        let missed_periods = now.saturating_since(self.deadline).as_nanos() / self.task_period.as_nanos();
        self.begin_period(now, missed_periods);
        self.refresh_outputs();
        self.refresh_inputs();
        for runtime in &mut self.attached {
            runtime.run(&mut self.io);
        }
        if self.mode == OperatingMode::Run {
            self.user_program.run(&mut self.io);
        }
        self.io.nx_objects.send(&mut self.bus.messages);
        if self.io.nx_bus_reset == NxBusReset::Asked {
            self.io.nx_bus_reset = NxBusReset::UnderWay;
            self.reset_errors();
        }
        self.deadline += self.task_period * (missed_periods + 1);
        self.note_reports();
    }

    /// Notes what the programs have reported in this task period.
    fn note_reports(&mut self) {
        let events = self.io.program_reports.take().filter_map(|record| {
            let CpuEvent::Program(event) = record.event else { return None };
            Some(event)
        });
        self.reports.period(events);
    }

    /// What its programs have reported since it was powered on first.
    #[must_use]
    pub const fn reports(&self) -> &Reports {
        &self.reports
    }

    /// When it was powered on.
    #[must_use]
    pub const fn powered_on(&self) -> Instant {
        self.powered_on
    }

    /// The operating mode.
    #[must_use]
    pub const fn mode(&self) -> OperatingMode {
        self.mode
    }

    /// Changes the operating mode, effective from the next task period. With RUN mode the user program starts
    /// again. Forced values are kept.
    pub fn set_mode(&mut self, mode: OperatingMode) {
        if self.mode != mode {
            self.mode = mode;
            self.user_program.start_anew();
            self.io.log(CpuEvent::ModeChanged(mode));
        }
    }

    /// Replaces the user program. Forced values are kept, and so are the values of device variables and of
    /// variables that both programs declare with RETAIN.
    ///
    /// # Errors
    /// [`NotInProgramMode`]: then the old program remains.
    pub fn load(&mut self, program: Box<dyn Program + Send>) -> Result<(), NotInProgramMode> {
        if self.mode != OperatingMode::Program {
            return Err(NotInProgramMode);
        }
        self.user_program.replace(program, &mut self.io);
        let asked = self.user_program.task_period().filter(|period| !period.is_zero());
        self.task_period = asked.unwrap_or(self.own_period);
        self.io.log(CpuEvent::ProgramLoaded);
        Ok(())
    }

    /// Replaces the user program in any mode: a CPU Unit in RUN mode goes to PROGRAM mode for it, and returns.
    pub fn change_program(&mut self, program: Box<dyn Program + Send>) {
        let mode = self.mode;
        self.set_mode(OperatingMode::Program);
        if self.load(program).is_err() {
            unreachable!("the CPU Unit is in PROGRAM mode");
        }
        self.set_mode(mode);
    }

    /// Attaches an outside runtime, such as another PLC or an HMI. It runs before the user program, and in
    /// every operating mode: outside runtimes do not stop with this CPU Unit.
    pub fn attach(&mut self, runtime: Box<dyn Program + Send>) {
        self.attached.push(Slot::new(runtime));
    }

    /// Whether the user program has stopped itself ([`crate::ProgramEvent::Stopped`]).
    #[must_use]
    pub fn has_program_stopped(&self) -> bool {
        self.user_program.is_stopped()
    }

    /// The value of a variable of the user program as text, by its name; none if there is none.
    #[must_use]
    pub fn program_variable(&self, name: &str) -> Option<String> {
        self.user_program.variable(name)
    }

    /// A value of a variable of the user program in the notation of [`Self::program_variable`]; none if there is no such
    /// variable, or it has no such value.
    #[must_use]
    pub fn program_value(&self, name: &str, text: &str) -> Option<String> {
        self.user_program.value_of_variable(name, text)
    }

    /// Takes the pending events, the oldest first. At most [`crate::CPU_EVENTS_MAX`] are kept, and one that
    /// repeats is one record.
    pub fn take_events(&mut self) -> impl ExactSizeIterator<Item = CpuRecord> {
        self.io.events.take()
    }

    /// Begins to keep the events for [`Self::take_observed`] too.
    pub fn observe(&mut self) {
        self.io.observed = Some(ObservedEvents::new(self.powered_on));
    }

    /// Gives the observer the events that are due: a new one at once, and one that repeats at most once a second, with its
    /// number of occurrences. [`Self::take_events`] has them too.
    pub fn take_observed(&mut self, now: Instant, give: impl FnMut(CpuRecord)) {
        if let Some(observed) = &mut self.io.observed {
            observed.take(now, give);
        }
    }

    /// Gives the observer all events that it has not got.
    pub fn take_all_observed(&mut self, give: impl FnMut(CpuRecord)) {
        if let Some(observed) = &mut self.io.observed {
            observed.take_all(give);
        }
    }

    /// Number of event records lost since the last call, because the observer did not get them in time.
    pub fn take_observed_lost(&mut self) -> u64 {
        self.io.observed.as_mut().map_or(0, ObservedEvents::take_lost)
    }

    /// Number of event records lost since power-on, because they were not taken.
    #[must_use]
    pub const fn events_lost(&self) -> u64 {
        self.io.events.lost()
    }

    /// Resets the errors of the NX Bus Function Module and, with its next refresh, those of the unit. I/O
    /// refreshing that was stopped by an error continues, unless the cause persists (manual, 8-3-4).
    pub const fn reset_errors(&mut self) {
        self.nx_bus_function.reset_errors();
    }

    /// Switches the power of the CPU Rack off and on, for the CPU Unit: its first task period begins at `now`,
    /// in the operating mode of its settings. All variables and forced values are initialized; RETAIN variables
    /// of the user program and the system time are kept. The NX Bus Function Module has no errors afterwards.
    /// Outside runtimes remain attached: they have their own power supply.
    pub fn cycle_power(&mut self, now: Instant) {
        self.system_time_ns = self.system_time_ns_at(now);
        (self.powered_on, self.deadline) = (now, now + self.task_phase);
        (self.has_power, self.is_task_stopped) = (true, false);
        self.mode = self.mode_at_power_on;
        self.io_refreshing = true;
        self.nx_bus_function.power_on();
        self.io.power_on();
        self.io.events.power_on(now);
        self.io.observed.iter_mut().for_each(|observed| observed.log_mut().power_on(now));
        self.user_program.start_anew();
        self.announce();
    }

    /// Switches its power off until [`Self::cycle_power`]. Its variables are initialized.
    pub fn power_off(&mut self, now: Instant) {
        self.cycle_power(now);
        self.has_power = false;
    }

    /// Whether it has power.
    #[must_use]
    pub const fn has_power(&self) -> bool {
        self.has_power
    }

    /// Its primary periodic task stops, with its I/O refresh.
    pub const fn stop_task(&mut self) {
        self.is_task_stopped = true;
    }

    /// The task continues, if it was stopped.
    pub const fn start_task(&mut self) {
        self.is_task_stopped = false;
    }

    /// Whether the NX Bus Function Module has stopped I/O refreshing because of an error of the unit.
    #[must_use]
    pub fn is_io_stopped(&self) -> bool {
        self.nx_bus_function.refreshing() == IoRefreshing::Stopped
    }

    /// Sends this number of NX messages at once, in addition to those of the program: reads whose answers nobody takes.
    /// Those for which the bus has no room are given up, which the unit detects.
    pub fn load_nx_bus(&mut self, count: u64) {
        for _ in 0..count {
            // No call of a program has this number.
            let request = NxRequest { number: 0, index: ObjectIndex(0x1000), sub: SubIndex(0), value: None };
            if self.bus.messages.send(request).is_err() {
                return self.bus.messages.discard();
            }
        }
    }

    /// Sets whether the CPU Unit does I/O refreshing on the NX bus, from the next task period on. A CPU Unit
    /// that stops it has an error itself; the unit reports NX Unit I/O Communications Error (manual, 8-3-4,
    /// 80200000).
    pub fn set_io_refreshing(&mut self, io_refreshing: bool) {
        self.io_refreshing = io_refreshing;
    }

    /// Advances the system time; without effect on a CPU Unit without system time.
    pub fn jump_system_time(&mut self, ahead: Duration) {
        self.system_time_ns = self.system_time_ns.map(|time_ns| time_ns.saturating_add(ahead.as_nanos()));
    }

    /// The I/O as the user program sees it.
    #[must_use]
    pub const fn io(&self) -> &Io {
        &self.io
    }

    /// The I/O, for changes from outside the user program: new values are sent in the next task period.
    #[must_use]
    pub const fn io_mut(&mut self) -> &mut Io {
        &mut self.io
    }

    fn begin_period(&mut self, now: Instant, missed_periods: u64) {
        self.task_periods = self.task_periods.wrapping_add(1);
        let running = now.saturating_since(self.powered_on);
        let system_time_ns = self.system_time_ns_at(now);
        self.io.begin_period(Instant::ZERO + running, system_time_ns);
        if missed_periods > 0 {
            self.io.log(CpuEvent::TaskPeriodExceeded { missed_periods });
        }
    }

    fn system_time_ns_at(&self, now: Instant) -> Option<u64> {
        let running = now.saturating_since(self.powered_on);
        self.system_time_ns.map(|start_ns| start_ns.saturating_add(running.as_nanos()))
    }

    fn refresh_inputs(&mut self) {
        // Responses first: then no flag is older than a response.
        self.io.nx_objects.receive(&mut self.bus.messages);
        let image = self.bus.m_to_c.newest();
        match self.nx_bus_function.hear(&image.header) {
            Some(IoRefreshing::Stopped) => self.io.log(CpuEvent::IoRefreshingStopped),
            Some(IoRefreshing::GoesOn) => self.io.log(CpuEvent::IoRefreshingResumed),
            Some(IoRefreshing::Off) | None => {}
        }
        if !self.nx_bus_function.awaits_reset() {
            self.io.nx_bus_reset = NxBusReset::None;
        }
        let refreshing =
            if self.io_refreshing { self.nx_bus_function.refreshing() } else { IoRefreshing::Off };
        self.io.take_inputs(image.header, refreshing, image.bytes());
    }

    fn refresh_outputs(&mut self) {
        let header = CpuHeader { refreshing: self.io_refreshing, messages_enabled: true, ..self.header() };
        // What has been written from outside may be forced.
        self.io.memory.apply_forced();
        self.bus.c_to_m.publish(header, self.io.c_to_m());
    }

    /// After power-on, before the first task period: nothing is refreshed yet, but the unit knows which task to expect.
    fn announce(&mut self) {
        let header = self.header();
        self.bus.c_to_m.publish(header, self.io.c_to_m());
    }

    fn header(&self) -> CpuHeader {
        let mut header = CpuHeader {
            task_periods: self.task_periods,
            task_period: self.task_period,
            system_time_ns: self.io.system_time_ns().unwrap_or(0),
            ..CpuHeader::default()
        };
        self.nx_bus_function.tell(&mut header);
        header
    }
}

/// A user program is loaded in PROGRAM mode only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotInProgramMode;

impl fmt::Display for NotInProgramMode {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("the CPU Unit is in RUN mode, and a program is loaded in PROGRAM mode")
    }
}

impl core::error::Error for NotInProgramMode {}

impl fmt::Debug for CpuUnit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut fields = formatter.debug_struct("CpuUnit");
        fields.field("mode", &self.mode).field("task_period", &self.task_period);
        fields.field("deadline", &self.deadline).field("io", &self.io).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
