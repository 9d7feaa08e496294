//! The `Device` element.

use objects::ObjectTable;

use super::dictionary;
use super::document::{Document, ENGLISH};
use super::hex::{hex_binary, hex8, hex16, hex32};
use crate::sii;
use crate::type_names;
use crate::{
    CoeDetails, DeviceDescription, FmmuUsage, GeneralFlags, Mailbox, MailboxProtocols, Pdo, PortPhysics,
    SyncManager, SyncManagerType,
};

const SET: &str = "1";

pub(super) fn write(document: &mut Document, description: &DeviceDescription, table: &ObjectTable) {
    let physics = physics(&description.ports);
    document.element("Device", &[("Physics", &physics)], |document| {
        device_type(document, description);
        document.text_with("Name", &[("LcId", ENGLISH)], &description.name);
        document.element("Info", &[], |document| info(document, description));
        document.text("GroupType", &description.group.group_type);
        profile(document, description, table);
        for usage in &description.fmmus {
            document.text("Fmmu", fmmu_name(*usage));
        }
        for sync_manager in &description.sync_managers {
            write_sync_manager(document, sync_manager);
        }
        for pdo in &description.rx_pdos {
            write_pdo(document, "RxPdo", pdo);
        }
        for pdo in &description.tx_pdos {
            write_pdo(document, "TxPdo", pdo);
        }
        if let Some(mailbox) = &description.mailbox {
            write_mailbox(document, description, mailbox);
        }
        esc_presets(document, description);
        document.element("Eeprom", &[], |document| eeprom(document, description));
    });
}

/// One letter per port; unused ports at the end are left out.
fn physics(ports: &[PortPhysics]) -> String {
    let letter = |port: &PortPhysics| match port {
        PortPhysics::Mii => 'Y',
        PortPhysics::Ebus => 'K',
        PortPhysics::FastHotConnect => 'H',
        PortPhysics::Unused | PortPhysics::Other(_) => ' ',
    };
    ports.iter().map(letter).collect::<String>().trim_end().to_owned()
}

fn device_type(document: &mut Document, description: &DeviceDescription) {
    let (product, revision) = (hex32(description.product_code), hex32(description.revision));
    let serial = hex32(description.serial);
    let mut attributes = vec![("ProductCode", product.as_str()), ("RevisionNo", &revision)];
    if description.serial != 0 {
        attributes.push(("SerialNo", &serial));
    }
    if description.general_flags.contains(GeneralFlags::ENABLE_SAFE_OP) {
        attributes.push(("TcCfgModeSafeOp", SET));
    }
    if description.general_flags.contains(GeneralFlags::ENABLE_NOT_LRW) {
        attributes.push(("UseLrdLwr", SET));
    }
    document.text_with("Type", &attributes, &description.order_code);
}

fn info(document: &mut Document, description: &DeviceDescription) {
    let timeouts = &description.timeouts;
    if description.ebus_current_ma != 0 {
        document.element("Electrical", &[], |document| {
            document.text("EBusCurrent", &description.ebus_current_ma.to_string());
        });
    }
    document.element("StateMachine", &[], |document| {
        document.element("Timeout", &[], |document| {
            document.text("PreopTimeout", &timeouts.pre_op_ms.to_string());
            document.text("SafeopOpTimeout", &timeouts.safe_op_op_ms.to_string());
            document.text("BackToInitTimeout", &timeouts.back_to_init_ms.to_string());
            document.text("BackToSafeopTimeout", &timeouts.back_to_safe_op_ms.to_string());
        });
    });
    if description.mailbox.is_some() {
        document.element("Mailbox", &[], |document| {
            document.element("Timeout", &[], |document| {
                document.text("RequestTimeout", &timeouts.mailbox_request_ms.to_string());
                document.text("ResponseTimeout", &timeouts.mailbox_response_ms.to_string());
            });
        });
    }
    if description.general_flags.contains(GeneralFlags::IDENT_PHY_M) {
        document.text("IdentificationAdo", &hex16(description.identification_offset));
    }
    if description.general_flags.contains(GeneralFlags::IDENT_AL_STATUS) {
        document.text("IdentificationReg134", "true");
    }
}

fn profile(document: &mut Document, description: &DeviceDescription, table: &ObjectTable) {
    if table.iter().next().is_none() && description.diag_messages.is_empty() {
        return;
    }
    document.element("Profile", &[], |document| {
        if table.iter().next().is_some() {
            document.element("Dictionary", &[], |document| dictionary::write(document, table));
        }
        if description.diag_messages.is_empty() {
            return;
        }
        document.element("DiagMessages", &[], |document| {
            for message in &description.diag_messages {
                document.element("DiagMessage", &[], |document| {
                    document.text("TextId", &hex16(message.text_id));
                    document.text_with("MessageText", &[("LcId", ENGLISH)], &message.text);
                });
            }
        });
    });
}

const fn fmmu_name(usage: FmmuUsage) -> &'static str {
    match usage {
        FmmuUsage::Outputs => "Outputs",
        FmmuUsage::Inputs => "Inputs",
        FmmuUsage::MailboxState => "MBoxState",
        FmmuUsage::Unused | FmmuUsage::Other(_) => "",
    }
}

fn write_sync_manager(document: &mut Document, sync_manager: &SyncManager) {
    let name = match sync_manager.usage {
        SyncManagerType::MailboxOut => "MBoxOut",
        SyncManagerType::MailboxIn => "MBoxIn",
        SyncManagerType::Outputs => "Outputs",
        SyncManagerType::Inputs => "Inputs",
        SyncManagerType::Unused | SyncManagerType::Other(_) => "",
    };
    let lengths = [
        ("MinSize", sync_manager.min_bytes),
        ("MaxSize", sync_manager.max_bytes),
        ("DefaultSize", Some(sync_manager.default_bytes)),
    ];
    let mut attributes: Vec<(&str, String)> =
        lengths.iter().filter_map(|(name, bytes)| Some((*name, bytes.as_ref()?.to_string()))).collect();
    attributes.push(("StartAddress", hex16(sync_manager.start)));
    attributes.push(("ControlByte", hex8(sync_manager.control)));
    attributes.push(("Enable", (sync_manager.enable & 1).to_string()));
    for (bit, name) in [(1 << 2, "Virtual"), (1 << 3, "OpOnly")] {
        if sync_manager.enable & bit != 0 {
            attributes.push((name, SET.into()));
        }
    }
    let attributes: Vec<(&str, &str)> =
        attributes.iter().map(|(name, value)| (*name, value.as_str())).collect();
    document.text_with("Sm", &attributes, name);
}

fn write_pdo(document: &mut Document, element: &str, pdo: &Pdo) {
    let sync_manager = pdo.sync_manager.map(|number| number.to_string());
    let mut attributes = Vec::new();
    if let Some(number) = &sync_manager {
        attributes.push(("Sm", number.as_str()));
    }
    for (set, name) in [(pdo.fixed, "Fixed"), (pdo.mandatory, "Mandatory")] {
        if set {
            attributes.push((name, SET));
        }
    }
    document.element(element, &attributes, |document| {
        document.text("Index", &hex16(pdo.index.0));
        document.text("Name", &pdo.name);
        for entry in &pdo.entries {
            document.element("Entry", &[], |document| {
                document.text("Index", &hex16(entry.index.0));
                if entry.is_padding() {
                    return document.text("BitLen", &entry.bit_length.to_string());
                }
                document.text("SubIndex", &entry.sub.0.to_string());
                document.text("BitLen", &entry.bit_length.to_string());
                document.text("Name", &entry.name);
                document.text("DataType", &type_names::name(entry.data_type, entry.bit_length.into()));
            });
        }
    });
}

fn write_mailbox(document: &mut Document, description: &DeviceDescription, mailbox: &Mailbox) {
    let layer = description.general_flags.contains(GeneralFlags::MAILBOX_DATA_LINK_LAYER);
    let attributes: &[(&str, &str)] = if layer { &[("DataLinkLayer", SET)] } else { &[] };
    let has = |protocol| mailbox.protocols.contains(protocol);
    document.element("Mailbox", attributes, |document| {
        for (protocol, name) in [(MailboxProtocols::AOE, "AoE"), (MailboxProtocols::EOE, "EoE")] {
            if has(protocol) {
                document.empty(name, &[]);
            }
        }
        if has(MailboxProtocols::COE) {
            write_coe(document, description, mailbox.coe_details);
        }
        let others =
            [(MailboxProtocols::FOE, "FoE"), (MailboxProtocols::SOE, "SoE"), (MailboxProtocols::VOE, "VoE")];
        for (protocol, name) in others {
            if has(protocol) {
                document.empty(name, &[]);
            }
        }
    });
}

fn write_coe(document: &mut Document, description: &DeviceDescription, details: CoeDetails) {
    let names = [
        (CoeDetails::SDO_INFO, "SdoInfo"),
        (CoeDetails::PDO_ASSIGN, "PdoAssign"),
        (CoeDetails::PDO_CONFIG, "PdoConfig"),
        (CoeDetails::PDO_UPLOAD, "PdoUpload"),
        (CoeDetails::COMPLETE_ACCESS, "CompleteAccess"),
    ];
    let attributes: Vec<(&str, &str)> = names
        .into_iter()
        .filter(|(detail, _)| details.contains(*detail))
        .map(|(_, name)| (name, SET))
        .collect();
    if description.init_commands.is_empty() {
        return document.empty("CoE", &attributes);
    }
    document.element("CoE", &attributes, |document| {
        for command in &description.init_commands {
            document.element("InitCmd", &[], |document| {
                document.text("Transition", command.transition.letters());
                document.text("Index", &hex16(command.index.0));
                document.text("SubIndex", &hex8(command.sub.0));
                document.text("Data", &hex_binary(&command.data));
                document.text("Comment", &command.comment);
            });
        }
    });
}

fn esc_presets(document: &mut Document, description: &DeviceDescription) {
    let presets = &description.esc_presets;
    let registers = [
        ("Reg0108", presets.read_write_offset),
        ("Reg0400", presets.watchdog_divider),
        ("Reg0410", presets.pdi_watchdog),
        ("Reg0420", presets.process_data_watchdog),
    ];
    if registers.iter().all(|(_, value)| value.is_none()) {
        return;
    }
    document.element("ESC", &[], |document| {
        for (name, value) in registers {
            if let Some(value) = value {
                document.text(name, &hex16(value));
            }
        }
    });
}

fn eeprom(document: &mut Document, description: &DeviceDescription) {
    document.text("ByteSize", &description.eeprom_bytes.to_string());
    document.text("ConfigData", &hex_binary(&sii::configuration(description)));
    if let Some(areas) = description.mailbox.as_ref().and_then(|mailbox| mailbox.bootstrap) {
        document.text("BootStrap", &hex_binary(&sii::area_words(areas)));
    }
}
