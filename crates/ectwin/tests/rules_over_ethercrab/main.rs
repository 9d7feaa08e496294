//! The setting rules with ethercrab, in memory: each violated once, and corrected.
//!
//! A violated PDO rule keeps the unit in PRE-OP, a violated I/O entry rule prevents the start of I/O
//! refreshing, a mismatch stops nothing.

#![cfg(feature = "ethercrab")]
#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod bench;
#[path = "../patient_master/mod.rs"]
mod patient_master;

use ectwin::AlState;
use ethercrab::error::{CoeAbortCode, Error, MailboxError};

use bench::{
    Bench, EXCHANGING, MISMATCHED, NOT_REFRESHED, Seen, Setting, assign_rx, assign_tx, entry, image, input,
    output, rx, tx,
};

const UNIT: &str = "model = \"nx-ect101\"";
const FACTORY_BYTES: usize = 180;
const INVALID_INPUT_MAPPING: u16 = 0x0024;
const INVALID_OUTPUT_MAPPING: u16 = 0x0025;

/// A violated PDO rule, and its correction.
struct PdoCase {
    name: &'static str,
    broken: Vec<Setting>,
    al_status_code: u16,
    corrected: Vec<Setting>,
}

/// Each PDO rule that has an AL status code, by direction. The corrections restore the factory setting.
#[rustfmt::skip]
fn pdo_cases() -> Vec<PdoCase> {
    let case = |name, broken, al_status_code, corrected| PdoCase { name, broken, al_status_code, corrected };
    let (to_cpu, to_master) = (INVALID_OUTPUT_MAPPING, INVALID_INPUT_MAPPING);
    let factory_rx = || rx(1, 1..=6);
    let factory_tx = || tx(1, 1..=6);
    let assigned_rx = || assign_rx(&[0x1601]);
    let assigned_tx = || assign_tx(&[0x1A00, 0x1A01, 0x1BFE]);
    let stray = |base: u32, pdo| {
        let own = (1..=5).map(|sub| entry(base, 1, sub));
        Setting::Mapping(pdo, own.chain([entry(base, 2, 1)]).collect())
    };
    vec![
        case("mandatory: without 1A00", vec![assign_tx(&[0x1A01, 0x1BFE])], to_master, vec![assigned_tx()]),
        case("mandatory: a TxPDO in 1C12", vec![assign_rx(&[0x1601, 0x1A00])], to_cpu, vec![assigned_rx()]),
        case("mandatory: a TxPDO alone in 1C12", vec![assign_rx(&[0x1A00])], to_cpu, vec![assigned_rx()]),
        case("mandatory: an RxPDO in 1C13", vec![assign_tx(&[0x1A00, 0x1A01, 0x1601])], to_master, vec![assigned_tx()]),
        case("SyncManager order M to C", vec![assign_rx(&[0x1603, 0x1601])], to_cpu, vec![assigned_rx()]),
        case("SyncManager order M to C: twice", vec![assign_rx(&[0x1601, 0x1601])], to_cpu, vec![assigned_rx()]),
        case("SyncManager order C to M", vec![assign_tx(&[0x1A00, 0x1BFE, 0x1A01])], to_master, vec![assigned_tx()]),
        case("type M to C", vec![stray(0x7000, 0x1601)], to_cpu, vec![factory_rx()]),
        case("type C to M", vec![stray(0x6000, 0x1A01)], to_master, vec![factory_tx()]),
        case("type M to C: an input", vec![Setting::Mapping(0x1601, vec![entry(0x6000, 1, 1)])], to_cpu, vec![factory_rx()]),
        case("type C to M: an output", vec![Setting::Mapping(0x1A01, vec![entry(0x7000, 1, 1)])], to_master, vec![factory_tx()]),
        case("order M to C: not ascending", vec![rx(1, [1, 3, 2, 4])], to_cpu, vec![factory_rx()]),
        case("order M to C: not from 01", vec![rx(1, [2, 3, 4])], to_cpu, vec![factory_rx()]),
        case("order M to C: a gap", vec![rx(1, [1, 2, 4])], to_cpu, vec![factory_rx()]),
        case("order C to M: not ascending", vec![tx(1, [1, 3, 2, 4])], to_master, vec![factory_tx()]),
        case("order C to M: not from 01", vec![tx(1, [2, 3, 4])], to_master, vec![factory_tx()]),
        case("order C to M: a gap", vec![tx(1, [1, 2, 4])], to_master, vec![factory_tx()]),
        case("total M to C: 1,204 bytes", vec![rx(1, 1..=40), rx(3, [1]), assign_rx(&[0x1601, 0x1603])],
            to_cpu, vec![factory_rx(), assigned_rx()]),
        case("total C to M: 1,204 bytes", vec![tx(1, 1..=40), tx(3, [1]), assign_tx(&[0x1A00, 0x1A01, 0x1A03])],
            to_master, vec![factory_tx(), assigned_tx()]),
        case("both directions: the first rule decides", vec![rx(1, [2]), assign_tx(&[0x1A01])],
            to_master, vec![factory_rx(), assigned_tx()]),
    ]
}

#[tokio::test]
async fn a_broken_pdo_rule_keeps_the_unit_in_pre_op_until_it_is_corrected() {
    for PdoCase { name, broken, al_status_code, corrected } in pdo_cases() {
        let bench = Bench::power_on(UNIT);
        // PRE-OP with the error indication.
        assert_eq!(bench.refused(&broken).await, (0x0012, al_status_code), "{name}");
        bench.live.look(0, |unit| assert_eq!(unit.state(), AlState::PreOp, "{name}"));
        let group = bench.op(&corrected).await;
        let whole = |octet| image(octet, FACTORY_BYTES, FACTORY_BYTES);
        let wanted = Seen { flags: EXCHANGING, outputs: whole(output), inputs: whole(input) };
        bench.expect(name, &group, &wanted).await;
        bench.live.look(0, |unit| assert_eq!(unit.al_status_code().0, 0, "{name}"));
    }
}

/// Settings that are impossible, because the SDO that would write them is refused.
#[tokio::test]
async fn an_entry_or_pdo_that_does_not_exist_is_refused_when_it_is_written() {
    let bench = Bench::power_on(UNIT);
    let group = bench.pre_op(&[]).await;
    let unit = group.subdevice(&bench.master, 0).unwrap();
    let elements: [(&str, u16, u32); 5] = [
        ("7000:29 in 1601", 0x1601, 0x7000_29F0),
        ("6000:29 in 1601", 0x1601, 0x6000_29F0),
        ("1018:01, in no PDO, in 1A01", 0x1A01, 0x1018_0120),
        ("7000:01 with another length in 1601", 0x1601, 0x7000_0110),
        ("padding in 1A01", 0x1A01, 0x0000_0008),
    ];
    for (name, object, element) in elements {
        unit.sdo_write(object, 0, 0_u8).await.unwrap();
        expect_not_mappable(name, unit.sdo_write(object, 1, element).await);
    }
    for (name, object, pdo) in [("1604 in 1C12", 0x1C12, 0x1604_u16), ("1018 in 1C13", 0x1C13, 0x1018)] {
        unit.sdo_write(object, 0, 0_u8).await.unwrap();
        expect_not_mappable(name, unit.sdo_write(object, 1, pdo).await);
    }
}

fn expect_not_mappable(name: &str, written: Result<(), Error>) {
    let not_mappable = matches!(
        written,
        Err(Error::Mailbox(MailboxError::Aborted { code: CoeAbortCode::PdoMappingFailed, .. }))
    );
    assert!(not_mappable, "{name}: {written:?}");
}

/// Each I/O entry rule by direction, violated in a unit file.
const IO_CASES: &[(&str, &str)] = &[
    ("type M to C", "m_to_c.uints = [\"6000:01\", \"6001:01\"]\nc_to_m.uints = 6"),
    ("type C to M", "m_to_c.uints = 6\nc_to_m.uints = [\"7000:01\", \"7001:01\"]"),
    (
        "order M to C: not ascending",
        "m_to_c.uints = [\"6000:01\", \"6000:03\", \"6000:02\"]\nc_to_m.uints = 6",
    ),
    ("order M to C: not from 01", "m_to_c.uints = [\"6000:02\", \"6000:03\"]\nc_to_m.uints = 6"),
    ("order M to C: a gap", "m_to_c.uints = [\"6000:01\", \"6000:03\"]\nc_to_m.uints = 6"),
    (
        "order C to M: not ascending",
        "m_to_c.uints = 6\nc_to_m.uints = [\"7000:01\", \"7000:03\", \"7000:02\"]",
    ),
    ("order C to M: not from 01", "m_to_c.uints = 6\nc_to_m.uints = [\"7000:02\", \"7000:03\"]"),
    ("order C to M: a gap", "m_to_c.uints = 6\nc_to_m.uints = [\"7000:01\", \"7000:03\"]"),
    ("total M to C: 1,204 bytes", "m_to_c = { uints = 40, udint = 1 }\nc_to_m.uints = 6"),
    ("total C to M: 1,204 bytes", "m_to_c.uints = 6\nc_to_m = { uints = 40, udint = 1 }"),
];

#[tokio::test]
async fn a_broken_io_entry_rule_leaves_op_and_keeps_io_refreshing_from_starting() {
    for (name, io_allocation) in IO_CASES {
        let bench = Bench::power_on(&format!("{UNIT}\n[io_allocation]\n{io_allocation}"));
        let group = bench.op(&[]).await;
        let length_bytes = bench.live.look(0, |unit| unit.outputs().len());
        let wanted =
            Seen { flags: NOT_REFRESHED, outputs: vec![0; length_bytes], inputs: vec![0; FACTORY_BYTES] };
        bench.expect(name, &group, &wanted).await;
        bench.live.look(0, |unit| {
            assert_eq!((unit.state(), unit.al_status_code().0), (AlState::Op, 0), "{name}");
        });
    }
}

/// A data set by its key in the unit file and its number, with the bytes of an entry.
const DATA_SETS: [(&str, u16, usize); 3] = [("uints", 1, 30), ("bytes", 2, 10), ("udint", 3, 4)];
const ASSIGNED: [(&[u16], &[u16]); 3] = [
    (&[0x1601], &[0x1A00, 0x1A01, 0x1BFE]),
    (&[0x1602], &[0x1A00, 0x1A02, 0x1BFE]),
    (&[0x1603], &[0x1A00, 0x1A03, 0x1BFE]),
];

#[tokio::test]
async fn unequal_amounts_exchange_the_entries_that_both_sides_have() {
    for ((key, number, entry_bytes), (assigned_rx, assigned_tx)) in DATA_SETS.into_iter().zip(ASSIGNED) {
        for (io_entries, pdo_entries) in [(6, 4), (4, 6)] {
            let allocation = format!("m_to_c.{key} = {io_entries}\nc_to_m.{key} = {io_entries}");
            let bench = Bench::power_on(&format!("{UNIT}\n[io_allocation]\n{allocation}"));
            let mapped = [rx(number, 1..=pdo_entries), tx(number, 1..=pdo_entries)];
            let assigned = [assign_rx(assigned_rx), assign_tx(assigned_tx)];
            let group = bench.op(&[mapped, assigned].concat()).await;
            let (moved, bytes) = (4 * entry_bytes, |entries| usize::from(entries) * entry_bytes);
            let wanted = Seen {
                flags: MISMATCHED,
                outputs: image(output, moved, bytes(io_entries)),
                inputs: image(input, moved, bytes(pdo_entries)),
            };
            let name = format!("{key}: {io_entries} I/O entries, {pdo_entries} PDO entries");
            bench.expect(&name, &group, &wanted).await;
        }
    }
}

#[tokio::test]
async fn a_data_set_without_partner_stops_nothing_and_moves_nothing() {
    let bench = Bench::power_on(UNIT);
    let assigned = [assign_rx(&[0x1602]), assign_tx(&[0x1A00, 0x1A02, 0x1BFE])];
    let group = bench.op(&assigned).await;
    // 1602 and 1A02 map two BYTE arrays each; the CPU Unit has UINT arrays only.
    let wanted = Seen { flags: MISMATCHED, outputs: vec![0; FACTORY_BYTES], inputs: vec![0; 20] };
    bench.expect("1602 against UINT arrays", &group, &wanted).await;
}
