//! The server for NX messages: access rights, the unit's identity, the message buffers (manual, A-7 and A-5).

use nx_bus::{NxMessageError, NxRequest, NxValue};
use wire::{ObjectIndex, SubIndex};

use crate::messages::{Message, Messages};
use crate::nx_objects::{NxAccess, NxEntry, nx_object};
use crate::unit_information::UnitInformation;

const SERIAL_NUMBER: (u16, u8) = (0x1000, 7);
const FROM_MASTER: (u16, u8) = (0x5000, 1);
const TO_MASTER: (u16, u8) = (0x5001, 1);

/// Answers one request. The checks run in this order: existence, message access, subindex, access right,
/// length, readiness.
pub(crate) fn answer(
    request: &NxRequest,
    information: &UnitInformation,
    serial: u32,
    messages: &mut Messages,
) -> Result<NxValue, NxMessageError> {
    let entry = reach(request.index, request.sub)?;
    let place = (request.index.0, request.sub.0);
    match &request.value {
        None => Ok(information.nx_value(place).unwrap_or_else(|| read(place, entry, serial, messages))),
        Some(_) if entry.access == NxAccess::Ro => Err(NxMessageError::ReadOnly),
        Some(value) => write(place, entry, value, messages),
    }
}

fn reach(index: ObjectIndex, sub: SubIndex) -> Result<&'static NxEntry, NxMessageError> {
    let object = nx_object(index).ok_or(NxMessageError::ObjectDoesNotExist)?;
    if !object.message_access {
        return Err(NxMessageError::NotAccessibleByMessage);
    }
    object.entry(sub).ok_or(NxMessageError::SubindexDoesNotExist)
}

fn read(place: (u16, u8), entry: &NxEntry, serial: u32, messages: &mut Messages) -> NxValue {
    match place {
        SERIAL_NUMBER => serial.to_le_bytes().into_iter().collect(),
        FROM_MASTER => messages.m_to_c.read().iter().copied().collect(),
        TO_MASTER => messages.c_to_m.written().iter().copied().collect(),
        _ => entry.default.iter().copied().take(NxValue::new().capacity()).collect(),
    }
}

fn write(
    place: (u16, u8),
    entry: &NxEntry,
    value: &NxValue,
    messages: &mut Messages,
) -> Result<NxValue, NxMessageError> {
    let wrong_length = NxMessageError::LengthMismatch { expected_bytes: entry.size_bytes };
    if place != TO_MASTER {
        return Err(NxMessageError::ReadOnly);
    }
    let message: &Message = value.as_slice().try_into().map_err(|_| wrong_length)?;
    messages.c_to_m.write(message).map_err(|_| NxMessageError::NotReady)?;
    Ok(NxValue::new())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ask(
        messages: &mut Messages,
        index: u16,
        sub: u8,
        value: Option<&[u8]>,
    ) -> Result<Vec<u8>, NxMessageError> {
        let value = value.map(|value| value.iter().copied().collect());
        let request = NxRequest { number: 0, index: ObjectIndex(index), sub: SubIndex(sub), value };
        answer(&request, &UnitInformation::default(), 0x1234_5678, messages).map(|value| value.to_vec())
    }

    #[test]
    fn the_identity_can_be_read() {
        let mut messages = Messages::default();
        let mut read = |index, sub| ask(&mut messages, index, sub, None);
        assert_eq!(read(0x1000, 0), Ok(vec![7]));
        assert_eq!(read(0x1000, 2), Ok(b"NX-ECT101   ".to_vec()));
        assert_eq!(read(0x1000, 5), Ok(vec![1, 0, 0, 0]));
        assert_eq!(read(0x1000, 7), Ok(vec![0x78, 0x56, 0x34, 0x12]));
        assert_eq!(read(0x1001, 1), Ok(vec![0; 4]));
        assert_eq!(read(0x5000, 1), Ok(vec![0; 200]));
    }

    #[test]
    fn everything_else_is_refused_with_its_reason() {
        let mut messages = Messages::default();
        let message = [1; 200];
        let mut ask = |index, sub, value: Option<&[u8]>| ask(&mut messages, index, sub, value);
        assert_eq!(ask(0x1002, 0, None), Err(NxMessageError::ObjectDoesNotExist));
        assert_eq!(ask(0x1000, 1, None), Err(NxMessageError::SubindexDoesNotExist));
        assert_eq!(ask(0x1001, 4, None), Err(NxMessageError::SubindexDoesNotExist));
        for index in [0x6000, 0x6001, 0x6002, 0x6003, 0x7000, 0x7001, 0x7002] {
            assert_eq!(ask(index, 1, None), Err(NxMessageError::NotAccessibleByMessage));
            assert_eq!(ask(index, 1, Some(&[0; 4])), Err(NxMessageError::NotAccessibleByMessage));
        }
        assert_eq!(ask(0x5000, 1, Some(&message)), Err(NxMessageError::ReadOnly));
        assert_eq!(ask(0x5001, 0, Some(&[1])), Err(NxMessageError::ReadOnly));
        let expected_bytes = 200;
        for length in [0, 1, 199] {
            let value = &message[..length];
            assert_eq!(ask(0x5001, 1, Some(value)), Err(NxMessageError::LengthMismatch { expected_bytes }));
        }
        assert_eq!(ask(0x5001, 1, Some(&message)), Ok(Vec::new()));
        assert_eq!(ask(0x5001, 1, Some(&[2; 200])), Err(NxMessageError::NotReady));
        assert_eq!(ask(0x5001, 1, None), Ok(message.to_vec()), "the buffer is kept");
    }

    #[test]
    fn reading_5000_empties_it_and_reading_5001_does_not() {
        let mut messages = Messages::default();
        messages.m_to_c.write(&[7; 200]).expect("ready");
        messages.c_to_m.write(&[8; 200]).expect("ready");
        assert_eq!(ask(&mut messages, 0x5000, 1, None), Ok(vec![7; 200]));
        assert_eq!(ask(&mut messages, 0x5001, 1, None), Ok(vec![8; 200]));
        assert!(messages.m_to_c.is_ready() && messages.c_to_m.has_new());
    }
}
