//! From power-on to returned data.

use device::Network;
use nx_ect101::{DataSetKind, Direction, IoAllocation, NxEct101, SlaveStatus, UnitSettings, device_config};
use time::{Duration, Instant};

use crate::bench::{Bench, PRE_OP, SAFE_OP};

/// The bytes of a PDO mapping object with its entries 1 to `count`.
fn mapping(base: u32, count: u8) -> Vec<u8> {
    let entries = (1..=u32::from(count)).flat_map(|sub| (base | sub << 8).to_le_bytes());
    [count, 0].into_iter().chain(entries).collect()
}

fn counting(length_bytes: usize) -> Vec<u8> {
    (0..length_bytes).map(|at| at as u8).collect()
}

#[test]
fn the_factory_setting_goes_to_op_and_echoes() {
    let mut bench = Bench::power_on(IoAllocation::factory()).into_pre_op().into_op(180, 183);
    let inputs = bench.exchange(&counting(180), 183);
    assert_eq!(inputs, [&[0x17, 0x00][..], &counting(180), &[0]].concat());
}

#[test]
fn the_largest_mapping_goes_to_op_and_echoes() {
    let mut allocation = IoAllocation::empty();
    allocation.select(Direction::MToC, DataSetKind::Uints, 40);
    allocation.select(Direction::CToM, DataSetKind::Uints, 40);
    let mut bench = Bench::power_on(allocation).into_pre_op();
    bench.download_complete(0x1601, &mapping(0x7000_00F0, 40));
    bench.download_complete(0x1A01, &mapping(0x6000_00F0, 40));
    bench.download_complete(0x1C13, &[4, 0, 0x00, 0x1A, 0x01, 0x1A, 0xFE, 0x1B, 0xFF, 0x1B]);
    let mut bench = bench.into_op(1200, 1204);
    let inputs = bench.exchange(&counting(1200), 1204);
    assert_eq!(inputs, [&[0x17, 0x00][..], &counting(1200), &[0, 0]].concat());
}

#[test]
fn lengths_that_do_not_fit_the_mapping_are_refused() {
    for (outputs_bytes, inputs_bytes, code) in [(181, 183, 0x001D), (180, 182, 0x001E)] {
        let mut bench = Bench::power_on(IoAllocation::factory()).into_pre_op();
        bench.set_process_data(outputs_bytes, inputs_bytes);
        assert_eq!(bench.request(SAFE_OP), (PRE_OP | 0x10, code));
    }
}

#[test]
fn a_mapping_without_the_unit_status_is_refused() {
    let mut bench = Bench::power_on(IoAllocation::factory()).into_pre_op();
    bench.download_complete(0x1C13, &[1, 0, 0x01, 0x1A]);
    bench.set_process_data(180, 180);
    assert_eq!(bench.request(SAFE_OP), (PRE_OP | 0x10, 0x0024));
}

#[test]
fn an_sdo_response_is_complete_after_2_ms() {
    let mut bench = Bench::power_on(IoAllocation::factory()).into_pre_op();
    let took = bench.download_complete(0x1C12, &[1, 0, 0x01, 0x16]);
    assert!(took >= Duration::from_millis(2) && took < Duration::from_micros(2_500), "{took}");
}

#[test]
fn the_id_switch_is_in_the_alias_register_and_in_al_status() {
    let mut bench = Bench::power_on(IoAllocation::factory()).into_pre_op();
    assert_eq!(bench.read(0x0012, 2), [1, 0]);
    assert_eq!(bench.request(PRE_OP | 0x20), (PRE_OP | 0x20, 1));
}

#[test]
fn the_cpu_units_see_the_cables() {
    let settings = UnitSettings::default();
    let powered = [(); 2].map(|()| NxEct101::power_on(&settings));
    let [(first, mut first_bus), (second, mut second_bus)] = powered;
    let units = [first, second].map(|unit| (device_config(&settings), unit));
    let mut network = Network::power_on(units, Instant::ZERO);
    let mut now = Instant::ZERO;
    let mut links = |network: &mut Network<NxEct101>| {
        now += nx_ect101::slave_period(settings.timing, 0);
        network.poll(now);
        [&mut first_bus, &mut second_bus].map(|bus| {
            let status = SlaveStatus::from_bits(bus.m_to_c.newest().header.status);
            (status.in_port_link, status.out_port_link)
        })
    };
    assert_eq!(links(&mut network), [(true, true), (true, false)]);
    network.set_cable(1, false);
    assert_eq!(links(&mut network), [(true, false), (false, false)]);
    network.set_cable(1, true);
    assert_eq!(links(&mut network), [(true, true), (true, false)]);
}
