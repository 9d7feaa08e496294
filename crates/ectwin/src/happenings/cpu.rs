//! Records of CPU Units.

use plc::{CpuEvent, CpuRecord, ProgramEvent, ProgramTrouble};
use time::Instant;

use super::record::{Detail, Record};

/// A report of a CPU Unit.
pub(super) fn record(at: Instant, report: &CpuRecord) -> Record {
    let CpuRecord { event, count, .. } = report;
    let message = event.to_string();
    let times = if *count > 1 { format!(" ({count} times)") } else { String::new() };
    let record = Record::new(at, "cpu", Detail::Brief, format!("CPU Unit: {message}{times}"))
        .with("report", word(event))
        .with("message", message)
        .with("count", *count);
    match event {
        CpuEvent::ModeChanged(mode) => record.with("mode", mode.to_string()),
        CpuEvent::TaskPeriodExceeded { missed_periods } => record.with("missed_periods", *missed_periods),
        CpuEvent::Program(ProgramEvent::Stopped(trouble) | ProgramEvent::Error(trouble)) => {
            placed(record, trouble)
        }
        CpuEvent::ProgramLoaded
        | CpuEvent::IoRefreshingStopped
        | CpuEvent::IoRefreshingResumed
        | CpuEvent::Program(
            ProgramEvent::TaskOverrun { .. }
            | ProgramEvent::UserDefinedError { .. }
            | ProgramEvent::UserDefinedErrorsReset { .. },
        ) => record,
    }
}

const fn word(event: &CpuEvent) -> &'static str {
    match event {
        CpuEvent::ModeChanged(_) => "mode",
        CpuEvent::ProgramLoaded => "program_loaded",
        CpuEvent::TaskPeriodExceeded { .. } => "task_period_exceeded",
        CpuEvent::IoRefreshingStopped => "io_refreshing_stopped",
        CpuEvent::IoRefreshingResumed => "io_refreshing_resumed",
        CpuEvent::Program(event) => match event {
            ProgramEvent::Stopped(_) => "program_stopped",
            ProgramEvent::Error(_) => "program_error",
            ProgramEvent::TaskOverrun { .. } => "task_overrun",
            ProgramEvent::UserDefinedError { .. } => "user_defined_error",
            ProgramEvent::UserDefinedErrorsReset { .. } => "user_defined_errors_reset",
        },
    }
}

/// The place of a trouble, as far as it is known.
fn placed(record: Record, trouble: &ProgramTrouble) -> Record {
    let known = |number: usize| (number > 0).then_some(number);
    record
        .with_optional("file", trouble.file.as_deref())
        .with_optional("line", known(trouble.line))
        .with_optional("column", known(trouble.column))
}
