//! Likely cause and correction of each SDO abort code. The names of the codes are in [`SdoAbort::TABLE`].

use wire::SdoAbort;

use super::Advice;

type Row = (SdoAbort, Advice);

const fn row(code: SdoAbort, cause: &'static str, correction: &'static str) -> Row {
    (code, Advice::new(cause, correction))
}

/// Ascending by code, one row for each row of [`SdoAbort::TABLE`].
#[rustfmt::skip]
pub(super) const ADVICE: &[Row] = &[
    row(SdoAbort::TOGGLE_BIT_NOT_CHANGED, "Two segments in a row had the same toggle bit: one was lost or sent twice.", "Begin the transfer again; the toggle bit starts at 0 and changes with each segment."),
    row(SdoAbort::TIMEOUT, "The transfer took too long.", "Begin it again, with a longer time-out in the master."),
    row(SdoAbort::COMMAND_SPECIFIER_UNKNOWN, "The unit does not know the SDO command, or the command does not match the transfer in progress.", "Check the first byte of the SDO; do not mix two transfers."),
    row(SdoAbort::INVALID_BLOCK_SIZE, "A block transfer with a block size that is not possible.", "Use segmented transfer: CoE has no block transfer."),
    row(SdoAbort::INVALID_SEQUENCE_NUMBER, "A block transfer with a wrong sequence number.", "Use segmented transfer: CoE has no block transfer."),
    row(SdoAbort::CRC_ERROR, "The checksum of a block transfer was wrong.", "Use segmented transfer: CoE has no block transfer."),
    row(SdoAbort::OUT_OF_MEMORY, "The unit has no memory for the transfer.", "Transfer less at a time."),
    row(SdoAbort::UNSUPPORTED_ACCESS, "The object cannot be accessed in this way.", "Access its subindexes one by one; check the access right by `ectwin list objects`."),
    row(SdoAbort::WRITE_ONLY, "The entry can only be written.", "Do not read it."),
    row(SdoAbort::READ_ONLY, "The entry can only be read.", "Do not write it; `ectwin list objects` shows the access rights."),
    row(SdoAbort::SUBINDEX_ZERO_NOT_CLEARED, "An entry of a PDO mapping or assignment was written while subindex 0 counted it.", "Write 0 to subindex 0, then the entries, then their number to subindex 0."),
    row(SdoAbort::COMPLETE_ACCESS_UNSUPPORTED, "The object has no complete access.", "Access its subindexes one by one."),
    row(SdoAbort::EXCEEDS_MAILBOX, "The value is longer than the mailbox.", "Use segmented transfer."),
    row(SdoAbort::MAPPED_TO_RX_PDO, "The entry is mapped into an RxPDO: its value comes with the process data.", "Write it through the process data, or take it out of the mapping."),
    row(SdoAbort::OBJECT_DOES_NOT_EXIST, "The dictionary has no object of this index.", "Check the index by `ectwin list objects`."),
    row(SdoAbort::NOT_MAPPABLE, "The entry cannot be mapped into this PDO.", "Map entries whose access right names the PDO's direction."),
    row(SdoAbort::PDO_LENGTH_EXCEEDED, "The PDO would become longer, or have more entries, than it may.", "Map fewer or shorter entries, or use a further PDO."),
    row(SdoAbort::PARAMETER_INCOMPATIBILITY, "The value contradicts another parameter.", "Write the parameters in the order given in the manual."),
    row(SdoAbort::INTERNAL_INCOMPATIBILITY, "The unit's own settings contradict each other.", "Restore the default settings."),
    row(SdoAbort::HARDWARE_ERROR, "The hardware failed during the access, such as the non-volatile memory.", "Read the diagnosis history (0x10F3); restart the unit."),
    row(SdoAbort::LENGTH_MISMATCH, "The value has another length than the entry.", "Send as many bytes as the entry's type has: 1 for USINT, 2 for UINT, 4 for UDINT."),
    row(SdoAbort::LENGTH_TOO_HIGH, "The value is longer than the entry.", "Send as many bytes as the entry's type has."),
    row(SdoAbort::LENGTH_TOO_LOW, "The value is shorter than the entry.", "Send as many bytes as the entry's type has."),
    row(SdoAbort::SUBINDEX_DOES_NOT_EXIST, "The object exists, but has no such subindex.", "Check the subindex by `ectwin list objects`."),
    row(SdoAbort::VALUE_OUT_OF_RANGE, "The value is not one that the entry may have.", "Write a value that the manual lists for this entry."),
    row(SdoAbort::VALUE_TOO_HIGH, "The value is above the entry's maximum.", "Write a smaller value."),
    row(SdoAbort::VALUE_TOO_LOW, "The value is below the entry's minimum.", "Write a larger value."),
    row(SdoAbort::MODULE_LIST_MISMATCH, "The modules that the master configured are not those that are there.", "Compare 0xF030 with 0xF050."),
    row(SdoAbort::MAXIMUM_BELOW_MINIMUM, "A maximum was set below the minimum that belongs to it.", "Correct the one or the other."),
    row(SdoAbort::RESOURCE_NOT_AVAILABLE, "Something that the access needs is in use.", "Try again later."),
    row(SdoAbort::GENERAL, "The unit refused for a reason without a specific code.", "Read the diagnosis history (0x10F3)."),
    row(SdoAbort::CANNOT_TRANSFER, "The unit cannot transfer or store the value.", "Read the diagnosis history (0x10F3)."),
    row(SdoAbort::LOCAL_CONTROL, "The unit's internal status forbids the access: the value is under local control, such as by the ID switches.", "Change the setting at the unit itself."),
    row(SdoAbort::DEVICE_STATE, "The access is not possible in the present state of the EtherCAT state machine.", "Take the unit to the state in which the entry is accessible, often PRE-OP: `ectwin list objects`."),
    row(SdoAbort::NO_DICTIONARY, "The unit has no object dictionary, or could not make it.", "Restart the unit."),
    row(SdoAbort::NO_DATA, "There is nothing to read.", "Try again when there is data, such as an entry in the diagnosis history."),
];
