//! Conditions that an order is about to end: if one is true before the order, the present state must not fulfil the
//! expectation that follows.

use crate::model::{Bytes, Condition, CpuOrder, MasterOrder, Order, UnitOrder};

/// Whether an order changes what a condition is about to something else than the condition.
///
/// All parts of `all of` are true while it is, so that the end of one of them ends it. Of `any of` another part may stay
/// true, so that it ends if each of its parts does.
pub(crate) fn ends(order: &Order, condition: &Condition) -> bool {
    match (order, condition) {
        (_, Condition::AllOf(parts)) => parts.iter().any(|part| ends(order, part)),
        (_, Condition::AnyOf(parts)) => !parts.is_empty() && parts.iter().all(|part| ends(order, part)),
        _ => ends_one(order, condition),
    }
}

fn ends_one(order: &Order, condition: &Condition) -> bool {
    match order {
        Order::Master(order) => master_ends(order, condition),
        Order::Unit(order) => unit_ends(order, condition),
        Order::Cpu(order) => cpu_ends(order, condition),
        Order::Line(_) | Order::Expect(_) => false,
    }
}

fn master_ends(order: &MasterOrder, condition: &Condition) -> bool {
    match (order, condition) {
        (
            MasterOrder::Take { units, state } | MasterOrder::Request { units, state, .. },
            Condition::State { units: of, state: expected, .. },
        ) => units.overlaps(of) && state != expected,
        (
            MasterOrder::SetOutputs { unit, at, bytes },
            Condition::Outputs { unit: of, at: first, bytes: expected },
        ) => unit == of && differ(*at, bytes, *first, expected),
        (
            MasterOrder::WriteRegister { unit, register, bytes }
            | MasterOrder::WriteRegisterInHalves { unit, register, bytes },
            Condition::Register { unit: of, register: first, value },
        ) => unit == of && differ(register.0, bytes, first.0, value),
        (
            MasterOrder::WriteSdo { unit, entry, value }
            | MasterOrder::WriteSdoInSegments { unit, entry, value },
            Condition::Object { unit: of, entry: other, value: expected },
        ) => (unit, entry) == (of, other) && value != expected,
        _ => false,
    }
}

fn unit_ends(order: &UnitOrder, condition: &Condition) -> bool {
    match (order, condition) {
        (
            UnitOrder::InjectFault { units, .. },
            Condition::HasNoError { units: of } | Condition::RecordedNothing { units: of },
        ) => units.overlaps(of),
        _ => false,
    }
}

fn cpu_ends(order: &CpuOrder, condition: &Condition) -> bool {
    match (order, condition) {
        (CpuOrder::StopIoRefreshing { units }, Condition::IoDataActive { units: of, active }) => {
            *active && units.overlaps(of)
        }
        (CpuOrder::StartIoRefreshing { units }, Condition::IoDataActive { units: of, active }) => {
            !*active && units.overlaps(of)
        }
        _ => false,
    }
}

/// Whether bytes at two places have a byte in common that differs.
fn differ(at: u16, bytes: &Bytes, first: u16, expected: &Bytes) -> bool {
    let written = (usize::from(at)..).zip(&bytes.0);
    let expected = |place: usize| place.checked_sub(first.into()).and_then(|place| expected.0.get(place));
    written.into_iter().any(|(place, byte)| expected(place).is_some_and(|expected| expected != byte))
}
