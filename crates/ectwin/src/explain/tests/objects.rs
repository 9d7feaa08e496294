//! Objects and their entries, by index and by name.

use objects::ObjectCode;
use wire::{ObjectIndex, SubIndex};

use super::{explained, refused, subjects};
use crate::explain::Subject;

#[test]
fn every_object_and_every_entry_of_the_tables_is_explained() {
    for object in nx_ect101::object_table().iter() {
        let index = object.index;
        assert!(subjects(&index.to_string()).contains(&Subject::Object(index)), "{index}");
        for entry in &object.entries {
            let text = format!("{:X}:{}", index.0, entry.sub);
            let explanation = explained(&text);
            assert!(
                explanation.starts_with(&format!("object {index}:{}: {}", entry.sub, entry.name)),
                "{explanation}"
            );
        }
    }
    for object in nx_ect101::nx_objects() {
        assert!(subjects(&format!("{:04X}", object.index.0)).contains(&Subject::NxObject(object.index)));
        for entry in &object.entries {
            let text = format!("{}:{}", object.index, entry.sub);
            assert!(subjects(&text).contains(&Subject::NxEntry(object.index, entry.sub)), "{text}");
        }
    }
}

#[test]
fn an_object_shows_its_entries_and_an_entry_what_it_does() {
    let identity = explained("0x1018");
    assert!(
        identity.starts_with("object 0x1018: Identity Object\n  kind        record, with complete access"),
        "{identity}"
    );
    assert!(
        identity.contains("\n  :02         Product Code, U32, 32 bit, RO, default 0000017C"),
        "{identity}"
    );
    let flags = explained("10F3:05");
    for fragment in [
        "object 0x10F3:05: Flags",
        "0 to 1 hex",
        "written in PRE-OP, SAFE-OP, OP",
        "when communications start",
    ] {
        assert!(flags.contains(fragment), "{fragment}: {flags}");
    }
    let status = explained("2002:1");
    assert!(status.contains("bit 4       Observation\n  bit 5       Minor Fault"), "{status}");
    let slave_status = explained("6003:01");
    assert!(slave_status.contains("NX object 0x6003:01: EtherCAT Slave Status"), "{slave_status}");
    assert!(
        slave_status.contains("bit 9       Ready to Write Message Data to EtherCAT Master"),
        "{slave_status}"
    );
    assert!(explained("7000:07").contains("NX object   0x6000:07, Data Set in 15 UINT Arrays"));
}

#[test]
fn an_entry_that_does_not_exist_is_refused_with_those_that_exist() {
    assert_eq!(refused("1018:05"), "object 0x1018 has no subindex 05\nits subindexes are 00, 01, 02, 03, 04");
    assert!(refused("1001:04").contains("its subindexes are 00, 01, 02, 03"), "an NX object");
    assert!(refused("1019:00").starts_with("there is no object 0x1019\n"));
}

#[test]
fn a_gap_is_explained_as_sdo_information_describes_it() {
    let mut gaps = 0;
    for object in nx_ect101::object_table().iter() {
        for sub in (0..=object.max_sub().0).map(SubIndex).filter(|sub| object.is_gap(*sub)) {
            let text = explained(&format!("{}:{sub}", object.index));
            assert!(
                text.starts_with(&format!("object {}:{sub}: a gap without data\n", object.index)),
                "{text}"
            );
            gaps += 1;
        }
    }
    assert!(gaps >= 3, "10E0:02, 1C32:03, 1C33:03");
    let text = explained("10E0:02");
    for fragment in ["type        none, 0 bit", "access      none", "SDO abort code 0x0609_0011"] {
        assert!(text.contains(fragment), "{fragment}: {text}");
    }
}

/// Every name of the object dictionary, on both sides.
#[test]
fn every_name_of_an_object_and_of_an_entry_is_explained() {
    for object in nx_ect101::object_table().iter() {
        assert!(subjects(&object.name).contains(&Subject::Object(object.index)), "{}", object.name);
        for entry in &object.entries {
            let known = subjects(&entry.name);
            let is_variable = object.code == ObjectCode::Variable;
            let wanted = if is_variable {
                Subject::Object(object.index)
            } else {
                Subject::Entry(object.index, entry.sub)
            };
            assert!(known.contains(&wanted), "{}:{} {}", object.index, entry.sub, entry.name);
        }
    }
    for object in nx_ect101::nx_objects() {
        assert!(subjects(&object.name).contains(&Subject::NxObject(object.index)), "{}", object.name);
        for entry in &object.entries {
            let wanted = Subject::NxEntry(object.index, entry.sub);
            assert!(subjects(&entry.name).contains(&wanted), "{}:{} {}", object.index, entry.sub, entry.name);
        }
    }
    assert_eq!(subjects("Sysmac Error Status"), [Subject::Entry(ObjectIndex(0x2002), SubIndex(1))]);
    assert_eq!(subjects("minor fault"), subjects("Sysmac Error Status"), "a bit of it");
}

#[test]
fn a_name_of_many_entries_is_explained_as_their_list() {
    let text = explained("Number of entries");
    assert!(text.contains("object 0x1018:00: Number of entries, Identity Object\nobject "), "{text}");
    assert!(text.lines().all(|line| line.to_lowercase().contains(":00: number of entries, ")), "{text}");
}
