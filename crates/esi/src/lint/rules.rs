//! The rules for ESI files as a table: what is wrong, how to correct it, and the source of the rule.

use core::fmt;

/// How severe a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Legal, but worth knowing.
    Note,
    /// Wrong, but there is only one way to read it.
    Warning,
    /// The device cannot be as the file says.
    Error,
}

impl fmt::Display for Level {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        })
    }
}

/// A rule.
#[derive(Debug, PartialEq, Eq)]
pub struct Rule {
    /// Its code, such as `E301`.
    pub code: &'static str,
    /// The level of its findings.
    pub level: Level,
    /// What it demands.
    pub demands: &'static str,
    /// How to correct the file.
    pub correction: &'static str,
    /// Where the demand comes from.
    pub source: &'static str,
}

macro_rules! rules {
    ($($name:ident $code:literal $level:ident $demands:literal, $correction:literal, $source:literal;)*) => {
        $(
            #[doc = $demands]
            pub(crate) const $name: &Rule = &Rule {
                code: $code,
                level: Level::$level,
                demands: $demands,
                correction: $correction,
                source: $source,
            };
        )*
        /// All rules, by their codes.
        pub const RULES: &[&Rule] = &[$($name),*];
    };
}

rules! {
    // The file and the notation of values.
    CHARACTER_SET "E101" Warning "the bytes are in the character set that the file declares",
        "save the file in the declared character set, or declare ISO-8859-1", "XML 1.0, 4.3.3";
    NOT_A_NUMBER "E102" Error "a number is decimal, or hexadecimal with `#x`",
        "write it as 1234 or #x04D2", "ETG.2000, HexDecValue";
    NUMBER_TOO_LARGE "E103" Error "a number fits into its field",
        "correct the number", "ETG.2000, HexDecValue; ETG.1000.6, SII";
    NUMBER_AS_IN_C "E104" Warning "a hexadecimal number begins with `#x`, not with `0x`",
        "write #x instead of 0x: other tools read it as 0 or refuse the file", "ETG.2000, HexDecValue";
    NOT_A_BOOLEAN "E105" Warning "a flag is 0, 1, false or true",
        "write 1 or 0", "XML Schema, boolean";
    NOT_HEX_BINARY "E106" Error "bytes are an even number of hexadecimal digits",
        "write two digits for each byte, without a prefix", "XML Schema, hexBinary";
    EXTERNAL_FILE "E107" Warning "the file that an element names is beside this file and has the right root element",
        "put the file beside this one, or remove the element", "ETG.2000, DictionaryFile";
    TOO_MANY_DEVICES "E108" Error "a file has at most 10,000 devices",
        "split the file", "limit of ectwin";

    // Identity and ports.
    VENDOR_ID "E201" Error "the file has the ID of the vendor",
        "write the vendor ID that the EtherCAT Technology Group has assigned", "ETG.2000, Vendor/Id";
    PRODUCT_CODE "E202" Error "a device has a product code",
        "add the attribute ProductCode to Type", "ETG.2000, Device/Type; ETG.1000.6, SII word 0x0A";
    REVISION "E203" Warning "a device has a revision number",
        "add the attribute RevisionNo to Type", "ETG.2000, Device/Type; ETG.1000.6, SII word 0x0C";
    DEVICE_TWICE "E204" Warning "product code and revision number occur once",
        "remove one of the devices, or give it a revision of its own", "ETG.2000, Device/Type";
    ORDER_CODE "E205" Warning "a device has an order code",
        "write the order code as the text of Type", "ETG.2000, Device/Type";
    PHYSICS "E206" Warning "a device says which ports it has",
        "add the attribute Physics, such as YY", "ETG.2000, Device/Physics";
    PHYSICS_LETTER "E207" Warning "a port is Y, K, H or a blank, four of them at most",
        "write a letter for each port: Y for a cable, K for a backplane", "ETG.2000, Device/Physics";
    GROUP "E208" Warning "the group of a device is in the file",
        "add the group to Groups, or correct GroupType", "ETG.2000, Device/GroupType";

    // FMMUs and SyncManagers.
    FMMU_TEXT "E301" Warning "an FMMU is Outputs, Inputs, MBoxState, DynamicOutputs or DynamicInputs, or has no text",
        "write one of these texts", "ETG.2000, Device/Fmmu";
    SM_TEXT "E302" Warning "a SyncManager is MBoxOut, MBoxIn, Outputs or Inputs, or has no text",
        "write one of these texts", "ETG.2000, Device/Sm";
    SM_DIRECTION "E303" Warning "the text of a SyncManager, its control byte and its PDOs have one direction",
        "correct the text or the control byte: outputs are written by the master, bits 3 and 2 are 01",
        "ETG.1000.4, SyncManager; ETG.2000, Device/Sm";
    SM_START "E304" Error "a SyncManager has a start address, unless it is virtual",
        "add the attribute StartAddress", "ETG.2000, Device/Sm";
    SM_OVERLAP "E305" Error "the areas of two SyncManagers do not overlap; three buffers take three times the length",
        "move one of them, or make it shorter", "ETG.1000.4, SyncManager, buffered mode";
    SM_MEMORY "E306" Error "a SyncManager is inside the memory of the controller",
        "move it, or correct DpramSize", "ETG.1000.4, process data RAM";
    SM_LENGTHS "E307" Error "MinSize, DefaultSize and MaxSize ascend",
        "correct the lengths", "ETG.2000, Device/Sm";
    SM_DEFAULT_LENGTH "E308" Note "DefaultSize is the length of the PDOs that are assigned by default",
        "correct DefaultSize if no module and no operation mode changes the assignment", "ETG.2000, Device/Sm";
    SM_MAILBOX "E309" Error "a device with a mailbox has MBoxOut and MBoxIn with a length",
        "add both SyncManagers with DefaultSize", "ETG.1000.6, mailbox";
    SM_WITHOUT_MAILBOX "E310" Error "a device with SyncManagers for a mailbox has an element Mailbox",
        "add the element Mailbox with its protocols", "ETG.2000, Device/Mailbox";

    // PDOs.
    PDO_WITHOUT_INDEX "E401" Error "a PDO has an index",
        "add the element Index", "ETG.2000, RxPdo and TxPdo";
    PDO_TWICE "E402" Error "the index of a PDO occurs once in a device",
        "give one of them another index", "ETG.1000.6, PDO mapping";
    PDO_INDEX "E403" Note "an RxPDO is at 0x1600 to 0x17FF, a TxPDO at 0x1A00 to 0x1BFF",
        "choose an index of this range", "ETG.1000.6, object dictionary";
    PDO_SM "E404" Error "the SyncManager of a PDO is one of the device",
        "correct the attribute Sm of the PDO", "ETG.2000, RxPdo and TxPdo";
    PDO_EXCLUDED "E405" Warning "two PDOs that exclude each other are not both assigned by default",
        "remove the attribute Sm of one of them", "ETG.2000, Exclude";
    PDO_EXCLUDE_UNKNOWN "E406" Warning "a PDO excludes PDOs of the device",
        "correct or remove the element Exclude", "ETG.2000, Exclude";
    PDO_MANDATORY "E407" Warning "a mandatory PDO is assigned by default",
        "add the attribute Sm, or remove Mandatory", "ETG.2000, RxPdo and TxPdo";
    PDO_LENGTH "E408" Error "a PDO has at most 255 entries, as PDO mapping and SII can say",
        "split the PDO", "ETG.1000.6, PDO mapping; SII categories 50 and 51";
    ENTRY_WITHOUT_BITS "E409" Warning "an entry of a PDO has a length",
        "add BitLen, or remove the entry", "ETG.2000, Entry";
    ENTRY_WITHOUT_SUBINDEX "E410" Warning "an entry that is no padding has a subindex",
        "add SubIndex", "ETG.2000, Entry";
    ENTRY_TYPE "E411" Warning "the type of an entry is one of the standard, or of the dictionary",
        "write a name such as UINT, BIT2 or ARRAY [0..9] OF BYTE", "ETG.2000, DataType; ETG.1020, base data types";
    ENTRY_TYPE_BITS "E412" Warning "the length of an entry is that of its type",
        "correct BitLen or DataType", "ETG.1020, base data types";
    ENTRY_UNKNOWN "E413" Warning "an entry of a PDO is in the dictionary",
        "add the object or the subindex to the dictionary", "ETG.1000.6, PDO mapping";
    ENTRY_MAPPING "E414" Note "an entry of a PDO may be mapped in its direction",
        "add PdoMapping R or T to the flags of the object", "ETG.2000, Flags/PdoMapping";
    ENTRY_DICTIONARY_BITS "E415" Warning "an entry has the same length in its PDO and in the dictionary",
        "correct one of them", "ETG.1000.6, PDO mapping";

    // Mailbox.
    MAILBOX_PROTOCOLS "E501" Warning "a mailbox has a protocol",
        "add CoE or another protocol, or remove Mailbox", "ETG.2000, Device/Mailbox";
    INIT_COMMAND_UNUSABLE "E502" Error "an init command has an index and a transition",
        "add Index and Transition, such as PS", "ETG.2000, InitCmd";
    INIT_COMMAND_OBJECT "E503" Error "an init command writes an entry of the dictionary, in a state in which it is writable",
        "correct the index, or add the object to the dictionary", "ETG.2000, InitCmd; ETG.1000.6, SDO download";
    INIT_COMMAND_LENGTH "E504" Error "the data of an init command are as long as the entry",
        "correct Data", "ETG.1000.6, SDO download";
    PROTOCOL_UNSUPPORTED "E505" Note "a device made from the file answers CoE",
        "nothing: requests of this protocol are answered with mailbox error 2", "limit of ectwin";

    // Distributed clocks.
    MODE_TWICE "E601" Warning "the name of an operation mode occurs once",
        "rename one of them", "ETG.2000, OpMode";
    MODE_WORD "E602" Warning "an operation mode has AssignActivate",
        "add AssignActivate, #x0300 for SYNC0", "ETG.2000, OpMode; ETG.1000.4, 0x0980";
    MODE_SM "E603" Error "the SyncManagers and PDOs of an operation mode are those of the device",
        "correct the attribute No or the element Pdo", "ETG.2000, OpMode/Sm";

    // Slots and modules.
    MODULE_TWICE "E701" Error "the ident of a module occurs once",
        "give one of them another ident", "ETG.5001, module ident";
    MODULE_UNKNOWN "E702" Warning "the modules that a slot names are in the file",
        "add the module, or correct ModuleIdent or ModuleClass", "ETG.2000, Slot";
    SLOT_INCREMENT "E703" Warning "slots have increments if a module has indexes that depend on the slot",
        "add SlotPdoIncrement and SlotIndexIncrement", "ETG.5001, slot increments";
    SLOT_COUNT "E704" Warning "MaxSlotCount is not less than the slots that must have a module",
        "correct MaxSlotCount or MinInstances", "ETG.2000, Slots";

    // Dictionary.
    OBJECT_INDEX "E801" Error "an object has an index from 0x1000 to 0xFFFF",
        "correct the index", "ETG.1000.6, object dictionary";
    TWICE "E802" Warning "objects, subindexes and types occur once",
        "remove one of them", "ETG.2000, Dictionary";
    TYPE_UNKNOWN "E803" Warning "a type is one of the standard or of the dictionary",
        "define the type in DataTypes", "ETG.2000, DataTypes";
    TYPE_BITS "E804" Warning "BitSize is the length of the type",
        "correct BitSize or the type", "ETG.1020, base data types";
    ENTRY_BITS "E805" Error "an entry has 1 to 65,535 bits",
        "correct BitSize", "ETG.1000.6, SDO information";
    OBJECT_WITHOUT_SUBINDEX_0 "E806" Error "an array or a record has subindex 0",
        "add the SubItem with SubIdx 0", "ETG.1000.6, object dictionary";
    INFO_ITEMS "E807" Note "Info has a SubItem for each subindex of its type, elements of arrays too",
        "add or remove SubItem", "ETG.2000, ObjectInfo";
    DEFAULT_LENGTH "E808" Warning "a default is as long as its entry",
        "correct DefaultData", "ETG.2000, ObjectInfo";
    LIMITS "E809" Warning "the minimum of an entry is not above its maximum",
        "correct MinData and MaxData", "ETG.2000, ObjectInfo";
    ACCESS_TEXT "E810" Warning "access is ro, rw or wo",
        "write one of these", "ETG.2000, Flags/Access";
    MAPPING_TEXT "E811" Warning "PdoMapping is T, R or TR",
        "write T for inputs of the master, R for outputs", "ETG.2000, Flags/PdoMapping";
    IDENTITY "E812" Warning "object 0x1018 has the identity of Vendor and Type",
        "correct DefaultData of 0x1018, or the attributes of Type", "ETG.1000.6, identity object";
    MANDATORY_OBJECTS "E813" Note "a dictionary has the objects 0x1000, 0x1018 and 0x1C00, and the mapping of each PDO",
        "add the objects; they follow from Type, Sm and the PDOs", "ETG.1000.6, mandatory objects";

    // EEPROM.
    CATEGORY_EMPTY "E901" Warning "a category of the vendor has contents",
        "add Data, or remove the category", "ETG.2000, Eeprom/Category";
    CONFIGURATION "E902" Warning "a device has ConfigData of at most 14 bytes",
        "add ConfigData; the checksum is no part of it", "ETG.2000, Eeprom; ETG.1000.6, SII words 0 to 6";
    EEPROM_SIZE "E903" Error "ByteSize is a multiple of 128, and the contents fit",
        "correct ByteSize", "ETG.1000.6, SII word 0x3E";
    BOOTSTRAP "E904" Error "BootStrap has 8 bytes: start and length of both mailboxes",
        "correct BootStrap", "ETG.1000.6, SII words 0x14 to 0x17";
    IMAGE "E905" Error "a whole image has the checksum and the identity of the device",
        "make the image again from the device", "ETG.1000.6, SII";
    EMULATION "E906" Warning "a controller that follows each request by itself has no mailbox",
        "clear bit 8 of word 0 of ConfigData", "ETG.1000.4, 0x0141, device emulation";

    // Network files.
    TOO_MANY_SLAVES "N101" Error "a network has at most 65,535 slaves",
        "remove the others", "ETG.1000.4, position addressing";
    NETWORK_IDENTITY "N102" Error "a slave of a network has vendor ID and product code",
        "add VendorId and ProductCode to Info", "ETG.2100, Slave/Info";
    STATION_ADDRESS "N103" Error "a slave of a network has a station address of its own, other than 0",
        "correct PhysAddr", "ETG.2100, Slave/Info; ETG.1000.4, 0x0010";
    POSITION "N104" Warning "AutoIncAddr is the place of the slave in the file: 0, 65535, 65534 and so on",
        "correct AutoIncAddr, or move the slave", "ETG.2100, Slave/Info";
    IDENTIFICATION_TWICE "N105" Error "the number by which a slave is known again occurs once for a register",
        "give one of them another number", "ETG.2100, Slave/Info/Identification";
    PREVIOUS_SLAVE "N201" Error "a slave is connected to a slave that is before it in the file",
        "correct PhysAddr of PreviousPort, or move the slave", "ETG.2100, Slave/PreviousPort";
    PREVIOUS_LETTER "N202" Error "a port is A, B, C or D",
        "write the letter of the port", "ETG.2100, Slave/PreviousPort";
    PORT_TWICE "N203" Error "one slave is connected to a port",
        "correct Port of one of them", "ETG.2100, Slave/PreviousPort";
    NETWORK_COMMAND "N301" Error "an init command says what is sent, and to which address or index",
        "add Cmd with Adp and Ado or with Addr; for an SDO add Index", "ETG.2100, InitCmd";
    NETWORK_MAILBOX "N302" Error "a mailbox has Send and Recv with start and length",
        "add Start and Length", "ETG.2100, Slave/Mailbox";
    PDO_NOT_THERE "N303" Error "a PDO that is assigned to a SyncManager is one of the slave",
        "add the RxPdo or TxPdo, or correct the element Pdo", "ETG.2100, Slave/ProcessData";
    NETWORK_LENGTH "N304" Warning "the length of a SyncManager is that of the PDOs that are assigned to it",
        "correct DefaultSize, or the list of Pdo", "ETG.2100, Slave/ProcessData; ETG.1000.6, 0x001D and 0x001E";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_ascend_and_texts_are_fragments() {
        assert!(RULES.windows(2).all(|pair| pair[0].code < pair[1].code));
        for rule in RULES {
            for text in [rule.demands, rule.correction, rule.source] {
                assert!(!text.is_empty() && !text.ends_with('.'), "{}: {text}", rule.code);
            }
        }
    }
}
