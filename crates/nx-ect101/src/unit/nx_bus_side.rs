//! The exchange between the unit and the NX bus in addition to the data: decisions of the CPU Unit, NX
//! messages, statuses.

use device::RefreshCause;
use nx_bus::{CpuHeader, SlaveStatus, UnitHeader};

use crate::fault::Fault;
use crate::nx_server;
use crate::status::NxUnitStatus;
use crate::unit::NxEct101;
use crate::unit::task_watch::TaskWatch;

impl NxEct101 {
    /// If the CPU Unit stops I/O refreshing, or its task stops, the NX bus has no I/O communications.
    pub(super) fn watch_io_communications(&mut self, cause: RefreshCause, cpu: CpuHeader) {
        if cause == RefreshCause::Period {
            self.task_watch.pass();
        }
        self.task_watch.hear(cpu);
        let was_lost =
            core::mem::replace(&mut self.io_communications_lost, self.task_watch.is_lost(self.period));
        match (was_lost, self.io_communications_lost) {
            (false, true) => self.objects.diagnosis.see(Fault::IoCommunications),
            (true, false) => self.objects.diagnosis.see_no_more(Fault::IoCommunications),
            (true, true) | (false, false) => {}
        }
        self.is_initialized |= self.is_refreshed_by_cpu();
    }

    /// Before a reset of the errors: a CPU Unit that refreshes I/O again is no cause any more, even if the unit's next
    /// refresh is still to come.
    pub(super) fn look_for_io_communications(&mut self) {
        if !self.io_communications_lost {
            return;
        }
        self.task_watch.hear(self.bus.c_to_m.newest().header);
        if self.is_refreshed_by_cpu() {
            self.io_communications_lost = false;
            self.objects.diagnosis.see_no_more(Fault::IoCommunications);
        }
    }

    /// The unit starts: it watches the CPU Unit from the beginning.
    pub(super) fn start_to_watch(&mut self) {
        self.task_watch = TaskWatch::start(self.bus.c_to_m.newest().header);
        self.io_communications_lost = false;
        self.objects.diagnosis.see_no_more(Fault::IoCommunications);
    }

    /// Whether the CPU Unit does I/O refreshing.
    pub(super) fn is_refreshed_by_cpu(&self) -> bool {
        self.task_watch.is_refreshed(self.period)
    }

    /// The decisions of the NX Bus Function Module: to stop I/O refreshing, to reset the errors.
    pub(super) fn follow_nx_bus(&mut self, cpu: CpuHeader) {
        self.io_stopped = cpu.io_stopped;
        if cpu.error_resets != self.error_resets {
            self.error_resets = cpu.error_resets;
            self.reset_errors();
        }
    }

    /// The unit does not take part in the NX bus until its next refresh: it has lost its power, or restarts.
    /// Only the first is an error for the CPU Unit. NX messages of that time are not executed later.
    pub(super) fn leave_nx_bus(&mut self, error: bool) {
        self.status = SlaveStatus::default();
        self.nx_unit_status = NxUnitStatus::default();
        let error_resets = self.error_resets;
        let header = UnitHeader { status: self.status.bits(), error, error_resets, ..UnitHeader::default() };
        self.bus.m_to_c.publish(header, &self.m_to_c);
        self.bus.messages.leave();
    }

    /// The information from the unit to the CPU Unit, sent with its data.
    pub(super) fn header(&self) -> UnitHeader {
        UnitHeader {
            status: self.status.bits(),
            io_data_active: self.io_is_refreshed(),
            error: self.has_error(),
            messages_enabled: true,
            fail_soft_error: self.faults().any(Fault::is_fail_soft),
            error_resets: self.error_resets,
        }
    }

    /// Answers the received NX messages. Their effects are visible in the same refresh.
    pub(super) fn answer_messages(&mut self) {
        if self.bus.messages.take_discarded() {
            self.objects.diagnosis.inject(Fault::MessageCommunications);
        }
        let (information, serial) = (&self.settings.information, self.memory.contents().serial());
        let messages = &mut self.objects.messages;
        self.bus.messages.answer(|request| nx_server::answer(request, information, serial, messages));
    }
}
