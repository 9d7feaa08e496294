//! The examples of the manual, 5-3 and 6-3-4, by name.

use nx_ect101::unit_file::UnitFile;
use nx_ect101::{Configuration, Verdict};

/// A unit file with these sections.
fn check(sections: &str) -> Verdict {
    let text = format!("model = \"nx-ect101\"\n{sections}");
    let file = UnitFile::parse(&text).unwrap_or_else(|errors| panic!("{errors}"));
    Configuration::from_unit_file(&file).check()
}

/// The event codes of all findings.
fn events(verdict: &Verdict) -> Vec<String> {
    verdict.findings.iter().map(|finding| finding.event.to_string()).collect()
}

/// Rule, side, direction and data set of all findings.
fn places(verdict: &Verdict) -> Vec<String> {
    let place = |finding: &nx_ect101::Finding| {
        let data_set = finding.data_set.map_or("-".to_owned(), |index| format!("{:04X}", index.0));
        format!("{} {} {} {data_set}", finding.rule.id(), finding.side.id(), finding.direction.id())
    };
    verdict.findings.iter().map(place).collect()
}

/// Bytes that are exchanged by data set, M to C and C to M.
fn bytes(verdict: &Verdict) -> ([usize; 3], [usize; 3]) {
    let bytes: Vec<usize> = verdict.data_sets.iter().map(|set| set.exchanged_bytes()).collect();
    let [a, b, c, d, e, f] = bytes[..] else { panic!("six data sets") };
    ([a, b, c], [d, e, f])
}

#[test]
fn combination_ok_15_uint_arrays_meet_1601() {
    let verdict =
        check("[io_allocation.m_to_c]\nuints = 6\n[pdo]\nassign.rx = [0x1601]\nassign.tx = [0x1A00]\n");
    assert_eq!(events(&verdict), [""; 0]);
}

#[test]
fn combination_ng_15_uint_arrays_meet_1602() {
    let verdict =
        check("[io_allocation.m_to_c]\nuints = 6\n[pdo]\nassign.rx = [0x1602]\nassign.tx = [0x1A00]\n");
    assert_eq!(events(&verdict), ["39170000"]);
    assert_eq!(places(&verdict), ["combination assignment m_to_c -"]);
    assert_eq!(bytes(&verdict), ([0; 3], [0; 3]));
}

#[test]
fn type_ok_7000_in_15_uint_arrays_to_the_master() {
    let verdict = check(
        "[io_allocation.c_to_m]\nuints = [\"7000:01\"]\n[pdo]\nassign.rx = []\nassign.tx = [0x1A00, 0x1A01]\nmapping.1A01 = 1\n",
    );
    assert_eq!(events(&verdict), [""; 0]);
}

#[test]
fn type_ng_7001_in_15_uint_arrays_to_the_master() {
    let verdict = check(
        "[io_allocation.c_to_m]\nuints = [\"7001:01\"]\n[pdo]\nassign.rx = []\nassign.tx = [0x1A00, 0x1A01]\nmapping.1A01 = 1\n",
    );
    assert_eq!(events(&verdict), ["391A0000"]);
    assert_eq!(places(&verdict), ["type io_entry c_to_m 1601"]);
}

fn order(subs: &str) -> Verdict {
    check(&format!("[io_allocation.c_to_m]\nuints = [{subs}]\n[pdo]\nassign.rx = []\nmapping.1A01 = 4\n"))
}

#[test]
fn order_ok_01_02_03_04() {
    let verdict = order("\"7000:01\", \"7000:02\", \"7000:03\", \"7000:04\"");
    assert_eq!(events(&verdict), [""; 0]);
}

#[test]
fn order_ng_01_03_02_04_is_not_ascending() {
    let verdict = order("\"7000:01\", \"7000:03\", \"7000:02\", \"7000:04\"");
    assert_eq!(events(&verdict), ["39130000"]);
    assert_eq!(places(&verdict), ["order io_entry c_to_m 1601"]);
}

#[test]
fn order_ng_02_03_04_does_not_begin_at_01() {
    let verdict = order("\"7000:02\", \"7000:03\", \"7000:04\"");
    assert_eq!(events(&verdict), ["39130000"]);
}

#[test]
fn sync_manager_order_ok_1a00_1a01_1a03() {
    let verdict = check(
        "[io_allocation.c_to_m]\nuints = 6\nudint = 4\n[pdo]\nassign.rx = []\nassign.tx = [0x1A00, 0x1A01, 0x1A03]\n",
    );
    assert_eq!(events(&verdict), [""; 0]);
}

#[test]
fn sync_manager_order_ng_1a03_1a00_1a01() {
    let verdict = check(
        "[io_allocation.c_to_m]\nuints = 6\nudint = 4\n[pdo]\nassign.rx = []\nassign.tx = [0x1A03, 0x1A00, 0x1A01]\n",
    );
    assert_eq!(events(&verdict), ["392F0000"]);
    assert_eq!(places(&verdict), ["sm_order assignment c_to_m -"]);
}

#[test]
fn unit_status_1a00_is_mandatory() {
    let verdict = check("[pdo]\nassign.tx = [0x1A01, 0x1BFE]\n");
    assert_eq!(events(&verdict), ["35090000"]);
    assert_eq!(places(&verdict), ["mandatory assignment c_to_m -"]);
}

/// A unit file with this number of entries of each data set, the same on both sides.
fn symmetric([uints, bytes, udint]: [u8; 3]) -> Verdict {
    let io =
        |way: &str| format!("[io_allocation.{way}]\nuints = {uints}\nbytes = {bytes}\nudint = {udint}\n");
    let mapping = |base: &str| {
        format!("mapping.{base}1 = {uints}\nmapping.{base}2 = {bytes}\nmapping.{base}3 = {udint}\n")
    };
    let assign = "assign.rx = [0x1601, 0x1602, 0x1603]\nassign.tx = [0x1A00, 0x1A01, 0x1A02, 0x1A03, 0x1BFE, 0x1BFF]\n";
    check(&format!("{}{}[pdo]\n{assign}{}{}", io("m_to_c"), io("c_to_m"), mapping("160"), mapping("1A0")))
}

#[test]
fn allocation_factory_setting() {
    let verdict = check("");
    assert!(verdict.is_satisfied());
    assert_eq!(bytes(&verdict), ([180, 0, 0], [180, 0, 0]));
}

#[test]
fn allocation_uint_arrays_only_at_a_maximum() {
    let verdict = symmetric([40, 0, 0]);
    assert!(verdict.is_satisfied());
    assert_eq!(bytes(&verdict), ([1200, 0, 0], [1200, 0, 0]));
}

#[test]
fn allocation_uint_arrays_byte_arrays_and_udint() {
    let verdict = symmetric([10, 10, 30]);
    assert!(verdict.is_satisfied());
    assert_eq!(bytes(&verdict), ([300, 100, 120], [300, 100, 120]));
}

#[test]
fn matched_6_against_4_entries_exchanges_4() {
    for (io, pdo) in [(6, 4), (4, 6)] {
        let verdict = check(&format!(
            "[io_allocation]\nm_to_c.uints = {io}\nc_to_m.uints = {io}\n[pdo]\nmapping.1601 = {pdo}\nmapping.1A01 = {pdo}\n"
        ));
        assert_eq!(events(&verdict), ["39170000", "39160000"]);
        assert_eq!(places(&verdict), ["matched pdo_entry m_to_c 1601", "matched pdo_entry c_to_m 1A01"]);
        assert_eq!(bytes(&verdict), ([120, 0, 0], [120, 0, 0]));
    }
}

#[test]
fn total_beyond_1200_bytes_on_both_sides() {
    let verdict = symmetric([40, 0, 1]);
    assert_eq!(events(&verdict), ["391D0000", "391C0000", "392C0000", "392D0000"]);
    assert_eq!(bytes(&verdict), ([0; 3], [0; 3]));
}

#[test]
fn entries_beyond_the_maximum_on_both_sides() {
    let verdict = symmetric([0, 11, 0]);
    assert_eq!(events(&verdict), ["350A0000", "35090000", "391B0000", "391A0000"]);
    let expected = ["mandatory pdo_entry m_to_c 1602", "mandatory pdo_entry c_to_m 1A02"];
    assert_eq!(places(&verdict)[..2], expected);
    assert_eq!(places(&verdict)[2..], ["type io_entry m_to_c 1A02", "type io_entry c_to_m 1602"]);
}

#[test]
fn status_assigned_twice_makes_the_tx_pdos_too_long() {
    let verdict = check(
        "[io_allocation.c_to_m]\nuints = 40\n[pdo]\nassign.rx = []\nassign.tx = [0x1A00, 0x1A01, 0x1BFE, 0x1BFF, 0x1BFF]\nmapping.1A01 = 40\n",
    );
    assert_eq!(events(&verdict), ["35090000", "392F0000"]);
    let message = verdict.findings[0].message();
    assert_eq!(message, "the TxPDOs have 1205 bytes, the unit sends 1204 at most");
}

#[test]
fn every_finding_says_what_is_wrong_and_what_helps() {
    let verdict = check(
        "[io_allocation]\nm_to_c.uints = [\"6000:02\", \"6001:01\"]\nc_to_m.uints = 7\n[pdo]\nassign.tx = [0x1A01, 0x1A00, 0x1601]\n",
    );
    let words = |finding: &nx_ect101::Finding| {
        format!("{}: {}. {}", finding.event_name(), finding.message(), finding.correction())
    };
    let expected = [
        "TxPDO Mapping Error: 0x1C13:03 assigns 0x1601, which is not one of its PDOs. Assign only 0x1A00, 0x1A01, \
         0x1A02, 0x1A03, 0x1BFE, 0x1BFF.",
        "Incorrect TxPDO Mapping Order: 0x1C13:02 assigns 0x1A00 after 0x1A01. Assign the PDOs in ascending order \
         of their indexes, each once.",
        "Illegal I/O Entry Added M to C: I/O entry mapping 0x1A01 (Data Set in 15 UINT Arrays from EtherCAT Master \
         to CPU Unit) has 6001:01, which cannot be in it. Use only entries of 0x6000, subindexes 01 to 28.",
        "Incorrect I/O Entry Order M to C: I/O entry mapping 0x1A01 (Data Set in 15 UINT Arrays from EtherCAT \
         Master to CPU Unit) has 6000:02 where 6000:01 is expected. List the entries from subindex 01 in ascending \
         order without a gap.",
    ];
    assert_eq!(verdict.findings.iter().map(words).collect::<Vec<_>>(), expected);
}
