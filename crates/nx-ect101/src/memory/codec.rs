//! The bytes of a non-volatile memory, little endian: magic, version, length, contents, CRC-32 of all bytes before it.

use core::fmt;

use arrayvec::ArrayVec;
use coe_kit::history::DiagnosisHistory;
use crc::{CRC_32_ISO_HDLC, Crc};

use super::{ACCESS_RECORDS_MAX, DETAILS_MAX, ErrorLog, LogRecord, NonVolatileMemory, SYSTEM_RECORDS_MAX};
use crate::events::{Event, EventCode, EventLevel, EventLog};

const MAGIC: &[u8; 8] = b"ectwnvm\0";
const VERSION: u16 = 1;
const CHECKSUM_BYTES: usize = 4;
/// Largest EEPROM that an SII size word can represent.
const SII_BYTES_MAX: usize = 8 << 20;
/// Magic, version, length, serial number, software ID, length of the EEPROM.
const HEAD_BYTES: usize = 8 + 2 + 4 + 4 + 2 + 4;
/// Newest record, acknowledged, numbers of records.
const LOG_HEAD_BYTES: usize = 4;
/// Event, time, level, number of details, details.
const RECORD_BYTES_MAX: usize = 4 + 8 + 1 + 1 + 4 * DETAILS_MAX;

static CHECKSUM: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// Why the bytes are not the memory of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damage {
    /// They do not begin like a memory: they belong to another program.
    NoMemory,
    /// A version that this program does not support.
    Version {
        /// The version found.
        version: u16,
    },
    /// They are too short or too long.
    Length {
        /// The length found, in bytes.
        length_bytes: usize,
    },
    /// The checksum is wrong.
    Checksum,
    /// The checksum is correct but the contents are not valid.
    Contents,
}

impl fmt::Display for Damage {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoMemory => formatter.write_str("not the memory of a unit"),
            Self::Version { version } => write!(formatter, "version {version}, expected {VERSION}"),
            Self::Length { length_bytes } => {
                write!(formatter, "{length_bytes} bytes are not its whole length")
            }
            Self::Checksum => formatter.write_str("wrong checksum"),
            Self::Contents => formatter.write_str("contents that no unit has stored"),
        }
    }
}

impl core::error::Error for Damage {}

impl NonVolatileMemory {
    /// Maximum length in bytes of a memory with full logs: for code that allocates room.
    #[must_use]
    pub fn encoded_bytes_max(&self) -> usize {
        let records_max = SYSTEM_RECORDS_MAX + ACCESS_RECORDS_MAX;
        HEAD_BYTES + self.sii_image.len() + LOG_HEAD_BYTES + records_max * RECORD_BYTES_MAX + CHECKSUM_BYTES
    }

    /// Writes the memory to `bytes`, replacing their contents.
    pub fn encode_into(&self, bytes: &mut Vec<u8>) {
        bytes.clear();
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        let length_at = bytes.len();
        bytes.extend_from_slice(&[0; 4]);
        bytes.extend_from_slice(&self.file_serial.to_le_bytes());
        bytes.extend_from_slice(&self.software_id.to_le_bytes());
        bytes.extend_from_slice(&(self.sii_image.len() as u32).to_le_bytes());
        bytes.extend_from_slice(&self.sii_image);
        put_log(&self.error_log, bytes);
        let length_bytes = (bytes.len() + CHECKSUM_BYTES) as u32;
        bytes[length_at..length_at + 4].copy_from_slice(&length_bytes.to_le_bytes());
        bytes.extend_from_slice(&CHECKSUM.checksum(bytes).to_le_bytes());
    }

    /// Reads the bytes of [`NonVolatileMemory::encode_into`].
    ///
    /// # Errors
    /// The defect of the bytes.
    pub fn decode(bytes: &[u8]) -> Result<Self, Damage> {
        let length_bytes = bytes.len();
        let too_short = Damage::Length { length_bytes };
        // Checked first: bytes that begin in another way are another program's file, and not a damaged memory,
        // however short they are.
        if !bytes.starts_with(MAGIC) {
            return Err(Damage::NoMemory);
        }
        let (body, checksum) = bytes.split_last_chunk::<CHECKSUM_BYTES>().ok_or(too_short)?;
        let mut reader = Reader(body);
        reader.take::<8>().ok_or(too_short)?;
        let version = reader.u16().ok_or(too_short)?;
        if version != VERSION {
            return Err(Damage::Version { version });
        }
        if reader.u32().ok_or(too_short)? as usize != length_bytes {
            return Err(too_short);
        }
        if CHECKSUM.checksum(body) != u32::from_le_bytes(*checksum) {
            return Err(Damage::Checksum);
        }
        reader.memory().filter(|_| reader.0.is_empty()).ok_or(Damage::Contents)
    }
}

fn put_log(log: &ErrorLog, bytes: &mut Vec<u8>) {
    let history = &log.system;
    bytes.extend_from_slice(&[history.newest, u8::from(history.acknowledged), history.len() as u8]);
    log.system.iter().for_each(|record| put_record(record, bytes));
    bytes.push(log.access.len() as u8);
    log.access.iter().for_each(|record| put_record(record, bytes));
}

fn put_record(record: &LogRecord, bytes: &mut Vec<u8>) {
    bytes.extend_from_slice(&record.event.0.to_le_bytes());
    bytes.extend_from_slice(&record.time_ns.to_le_bytes());
    let level = match record.level {
        EventLevel::MinorFault => 0,
        EventLevel::Observation => 1,
        EventLevel::Information => 2,
    };
    bytes.extend_from_slice(&[level, record.details.len() as u8]);
    record.details.iter().for_each(|detail| bytes.extend_from_slice(&detail.to_le_bytes()));
}

/// The bytes that have not been read yet. Every read returns none if they end too early or are not valid.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn memory(&mut self) -> Option<NonVolatileMemory> {
        let (file_serial, software_id) = (self.u32()?, self.u16()?);
        let sii_bytes = usize::try_from(self.u32()?).ok().filter(|&bytes| bytes <= SII_BYTES_MAX)?;
        let (sii_image, rest) = self.0.split_at_checked(sii_bytes)?;
        let sii_image = sii_image.to_vec();
        self.0 = rest;
        Some(NonVolatileMemory { file_serial, software_id, sii_image, error_log: self.log()? })
    }

    fn log(&mut self) -> Option<ErrorLog> {
        let newest = self.u8()?;
        let acknowledged = self.bool()?;
        let system = DiagnosisHistory { records: self.records()?, newest, acknowledged };
        let log = ErrorLog { system, access: self.records()? };
        is_possible(&log).then_some(log)
    }

    fn records<const MAX: usize>(&mut self) -> Option<ArrayVec<LogRecord, MAX>> {
        let count = usize::from(self.u8()?);
        let mut records = ArrayVec::new();
        for _ in 0..count {
            records.try_push(self.record()?).ok()?;
        }
        Some(records)
    }

    fn record(&mut self) -> Option<LogRecord> {
        let (event, time_ns) = (EventCode(self.u32()?), u64::from_le_bytes(self.take()?));
        let level = match self.u8()? {
            0 => EventLevel::MinorFault,
            1 => EventLevel::Observation,
            2 => EventLevel::Information,
            _ => return None,
        };
        let mut details = ArrayVec::new();
        for _ in 0..self.u8()? {
            details.try_push(self.u32()?).ok()?;
        }
        Some(LogRecord { event, level, time_ns, details })
    }

    fn bool(&mut self) -> Option<bool> {
        match self.u8()? {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }

    fn u8(&mut self) -> Option<u8> {
        self.take().map(u8::from_le_bytes)
    }

    fn u16(&mut self) -> Option<u16> {
        self.take().map(u16::from_le_bytes)
    }

    fn u32(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    fn take<const BYTES: usize>(&mut self) -> Option<[u8; BYTES]> {
        let (bytes, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*bytes)
    }
}

/// Whether such a log is possible for a unit: its history is, and each event belongs in that log.
fn is_possible(log: &ErrorLog) -> bool {
    let all_are = |records: &[LogRecord], goes_there: fn(&Event) -> bool| {
        records.iter().all(|record| Event::find(record.event).is_some_and(goes_there))
    };
    log.system.is_possible()
        && all_are(&log.system, |event| event.logged)
        && all_are(&log.access, |event| event.event_log == EventLog::Access)
}
