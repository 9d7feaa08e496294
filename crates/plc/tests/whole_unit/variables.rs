//! Device variables of a unit that exchanges data with a master.

use nx_ect101::IoAllocation;
use plc::{CpuSettings, Io, OperatingMode, Program, Validity, VariableId};
use time::Duration;

use crate::bench::Bench;

/// The manual's example A-3-3, by the names of its I/O map.
#[derive(Default)]
struct CopyWhenValid {
    ids: Option<[VariableId; 6]>,
}

impl Program for CopyWhenValid {
    fn start(&mut self, io: &mut Io) {
        let names = [
            "NXBus_N1_NX_Unit_I_O_Data_Active_Status",
            "NXBus_N1_NX_Unit_Error_Status",
            "N1_Data_from_EtherCAT_Master_to_CPU_Unit_Valid",
            "N1_Data_from_CPU_Unit_to_EtherCAT_Master_Valid",
            "N1_UINTs_01_M_to_C",
            "N1_UINTs_01_C_to_M",
        ];
        self.ids = Some(names.map(|name| io.find(name).expect(name)));
    }

    fn scan(&mut self, io: &mut Io) {
        let [active, error, m_to_c_valid, c_to_m_valid, from, to] = self.ids.expect("started");
        let is = |id: VariableId| io.read(id).expect("a BOOL")[0] == 1;
        if is(active) && !is(error) && is(m_to_c_valid) && is(c_to_m_valid) {
            let value = io.read(from).expect("an array");
            io.write(to, &value).expect("an output");
        }
    }
}

fn bench() -> Bench {
    let settings = CpuSettings::default();
    let mut bench =
        Bench::with_program(IoAllocation::factory(), settings, CopyWhenValid::default()).into_pre_op();
    bench.access.run_for(Duration::from_millis(5));
    bench.into_op(180, 183)
}

fn id(bench: &Bench, name: &str) -> VariableId {
    bench.access.line.cpu.io().find(name).expect(name)
}

fn read(bench: &Bench, name: &str) -> Vec<u8> {
    bench.access.line.cpu.io().read(id(bench, name)).expect("of this list").to_vec()
}

#[test]
fn the_manuals_program_copies_by_the_names_of_its_io_map() {
    let mut bench = bench();
    let inputs = bench.exchange(&[7; 180], 183);
    assert_eq!(inputs[2..32], [7; 30], "UINTs 01 come back");
    assert_eq!(inputs[32..182], [0; 150], "the others do not");
    assert_eq!(read(&bench, "N1_EtherCAT_Slave_Status"), [0x47, 0x02]);
    let entry = id(&bench, "N1_UINTs_01_M_to_C");
    assert_eq!(bench.access.line.cpu.io().validity(entry), Ok(Validity::Valid));
    assert_eq!(read(&bench, "_NXB_UnitMsgActiveTbl")[..3], [1, 1, 0]);
}

#[test]
fn a_forced_input_is_what_the_program_sees_and_a_forced_output_what_the_master_gets() {
    let mut bench = bench();
    let (input, output) = (id(&bench, "N1_UINTs_01_M_to_C"), id(&bench, "N1_UINTs_01_C_to_M"));
    bench.access.line.cpu.io_mut().force(input.element(0), &[0x34, 0x12]).expect("an element");
    bench.access.line.cpu.io_mut().force(output.element(14), &[0xFF, 0xFF]).expect("an element");
    let inputs = bench.exchange(&[7; 180], 183);
    assert_eq!((inputs[2..4].to_vec(), inputs[4..30].to_vec()), (vec![0x34, 0x12], vec![7; 26]));
    assert_eq!(inputs[30..32], [0xFF, 0xFF]);
    bench.access.line.cpu.set_mode(OperatingMode::Program);
    bench.access.line.cpu.io_mut().release(output).expect("an array");
    let inputs = bench.exchange(&[8; 180], 183);
    assert_eq!(inputs[30..32], [0xFF, 0xFF], "nobody has written it since the release");
    bench.access.line.cpu.set_mode(OperatingMode::Run);
    let inputs = bench.exchange(&[9; 180], 183);
    assert_eq!((inputs[2..4].to_vec(), inputs[30..32].to_vec()), (vec![0x34, 0x12], vec![9, 9]));
}

#[test]
fn a_unit_without_power_cannot_be_asked_and_has_an_error() {
    let mut bench = bench();
    bench.power_off();
    bench.access.run_for(Duration::from_millis(5));
    assert_eq!(read(&bench, "_NXB_UnitMsgActiveTbl")[..2], [1, 0]);
    assert_eq!(read(&bench, "_NXB_UnitErrFlagTbl")[..2], [0, 1]);
    let entry = id(&bench, "N1_UINTs_01_M_to_C");
    assert_eq!(bench.access.line.cpu.io().validity(entry), Ok(Validity::IoDataNotActive));
}
