//! What goes between the unit and the NX bus besides the data: what the CPU Unit has decided, NX messages, statuses.

use device::RefreshCause;

use crate::fault::Fault;
use crate::nx_bus::{CpuHeader, UnitHeader};
use crate::nx_server;
use crate::status::{NxUnitStatus, SlaveStatus};
use crate::unit::NxEct101;

impl NxEct101 {
    /// A CPU Unit that stops I/O refreshing, or its task, is an NX bus without I/O communications.
    pub(super) fn watch_io_communications(&mut self, cause: RefreshCause, cpu: CpuHeader) {
        if cause == RefreshCause::Period {
            self.task_watch.pass(cpu.task_periods);
        }
        let refreshing = cpu.refreshing && !self.task_watch.has_stopped(self.period, cpu.task_period);
        if self.cpu_refreshing && !refreshing {
            self.io_communications_lost = true;
            self.objects.diagnosis.see(Fault::IoCommunications);
        } else if refreshing && core::mem::take(&mut self.io_communications_lost) {
            self.objects.diagnosis.see_no_more(Fault::IoCommunications);
        }
        self.cpu_refreshing = refreshing;
        self.is_initialized |= refreshing;
    }

    /// What the NX Bus Function Module has decided: to stop I/O refreshing, to reset the errors.
    pub(super) fn follow_nx_bus(&mut self, cpu: CpuHeader) {
        self.io_stopped = cpu.io_stopped;
        if cpu.error_resets != self.error_resets {
            self.error_resets = cpu.error_resets;
            self.reset_errors();
        }
    }

    /// The unit takes no part in the NX bus until its next refresh: it has lost its power, or starts again. Only the
    /// first is an error for the CPU Unit.
    pub(super) fn leave_nx_bus(&mut self, error: bool) {
        self.status = SlaveStatus::default();
        self.nx_unit_status = NxUnitStatus::default();
        let error_resets = self.error_resets;
        let header = UnitHeader { status: self.status, error, error_resets, ..UnitHeader::default() };
        self.bus.m_to_c.publish(header, &self.m_to_c);
    }

    /// What the unit tells the CPU Unit along with its data.
    pub(super) fn header(&self) -> UnitHeader {
        UnitHeader {
            status: self.slave_status(),
            io_data_active: self.io_is_refreshed(),
            error: self.has_error(),
            messages_enabled: true,
            fail_soft_error: self.faults().any(Fault::is_fail_soft),
            error_resets: self.error_resets,
        }
    }

    /// Answers the NX messages that have come. What they change shows in the same refresh.
    pub(super) fn answer_messages(&mut self) {
        if self.bus.messages.take_discarded() {
            self.objects.diagnosis.inject(Fault::MessageCommunications);
        }
        let (information, serial) = (&self.settings.information, self.memory.contents().serial());
        let messages = &mut self.objects.messages;
        self.bus.messages.answer(|request| nx_server::answer(request, information, serial, messages));
    }
}
