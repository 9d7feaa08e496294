//! One unit of the line, as clients read and write it.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use opcua::types::{DataValue, DateTime, NumericRange, StatusCode, TimestampsToReturn, Variant};
use plc::outside::{ChangeRefused, OutsideEnd, Ticket};
use plc::{DeviceVariables, Validity, VariableAccess, VariableError, VariableId};

use crate::value;

/// How long a write request waits for the task period that executes it.
const PATIENCE: Duration = Duration::from_secs(1);
/// Interval of its checks: the shortest that the timers of the runtime offer.
const LOOK: Duration = Duration::from_millis(1);

/// A unit shared by all sessions.
pub(crate) struct Unit {
    variables: DeviceVariables,
    /// Locked only while values are copied.
    end: Mutex<OutsideEnd>,
}

impl Unit {
    pub(crate) fn new(end: OutsideEnd) -> Self {
        Self { variables: end.variables().clone(), end: Mutex::new(end) }
    }

    pub(crate) const fn variables(&self) -> &DeviceVariables {
        &self.variables
    }

    /// The newest value with its quality, or the status that explains why there is none.
    pub(crate) fn read(
        &self,
        id: VariableId,
        range: &NumericRange,
        timestamps: TimestampsToReturn,
    ) -> DataValue {
        match self.value(id, range) {
            Ok((value, status)) => {
                let mut value =
                    DataValue { value: Some(value), status: Some(status), ..DataValue::default() };
                let now = DateTime::now();
                value.set_timestamps(timestamps, now, now);
                value
            }
            Err(status) => DataValue { status: Some(status), ..DataValue::default() },
        }
    }

    /// Sends a change of a variable or of elements of it; [`Unit::taken`] waits for it.
    pub(crate) fn write(
        &self,
        id: VariableId,
        range: &NumericRange,
        value: &Variant,
    ) -> Result<Ticket, StatusCode> {
        let variable = self.variables.get(id).ok_or(StatusCode::BadNodeIdUnknown)?;
        if variable.access == VariableAccess::ReadOnly {
            return Err(StatusCode::BadNotWritable);
        }
        let changes = value::changes(id, variable.variable_type, range, value)?;
        self.end().send(&changes).map_err(refusal)
    }

    /// Waits until the sent changes have been written, so that a client that writes can read them afterwards.
    pub(crate) async fn taken(&self, ticket: Ticket) -> StatusCode {
        let patience_ends = Instant::now() + PATIENCE;
        while !self.end().newest().has_taken(ticket) {
            if Instant::now() >= patience_ends {
                return StatusCode::GoodCompletesAsynchronously;
            }
            tokio::time::sleep(LOOK).await;
        }
        StatusCode::Good
    }

    fn value(&self, id: VariableId, range: &NumericRange) -> Result<(Variant, StatusCode), StatusCode> {
        let variable = self.variables.get(id).ok_or(StatusCode::BadNodeIdUnknown)?;
        let mut end = self.end();
        let image = end.newest();
        let is_not_there = |_: VariableError| StatusCode::BadNodeIdUnknown;
        let octets = image.read(id).map_err(is_not_there)?;
        let quality = quality(image.validity(id).map_err(is_not_there)?);
        Ok((value::to_variant(variable.variable_type, &octets).range_of_owned(range)?, quality))
    }

    /// A session that panicked left the end consistent: it is complete after each call.
    fn end(&self) -> MutexGuard<'_, OutsideEnd> {
        self.end.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The manual's conditions for valid I/O data (A-3-2), mapped to OPC UA.
const fn quality(validity: Validity) -> StatusCode {
    match validity {
        Validity::Valid => StatusCode::Good,
        Validity::IoDataNotActive => StatusCode::BadNoCommunication,
        Validity::UnitError => StatusCode::BadDeviceFailure,
        Validity::DataNotValid => StatusCode::UncertainLastUsableValue,
    }
}

fn refusal(refused: ChangeRefused) -> StatusCode {
    match refused {
        ChangeRefused::Variable { error: VariableError::NotWritable, .. } => StatusCode::BadNotWritable,
        ChangeRefused::Variable { .. } => StatusCode::BadOutOfRange,
        ChangeRefused::Full { .. } => StatusCode::BadResourceUnavailable,
        ChangeRefused::NotReachable => StatusCode::BadNoCommunication,
    }
}
