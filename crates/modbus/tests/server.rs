//! Clients of every kind at a server, with a CPU Unit that runs as fast as it can.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod bench;

use bench::Bench;
use plc::{Echo, Io};
use tokio_modbus::ExceptionCode;
use tokio_modbus::client::{Reader, Writer};

/// Like the user program of a machine: it writes its first output in every scan.
fn counts(io: &mut Io) {
    if let Some(entry) = io.entry_mut("UINTs", 1) {
        entry[0] = entry[0].wrapping_add(1);
    }
}

fn nothing(_: &mut Io) {}

#[test]
fn what_is_written_is_read_back_at_once() {
    Bench::with(nothing).run(async |bench| {
        let mut client = bench.client(1).await;
        for round in 0..100_u16 {
            let values: Vec<u16> = (0..87).map(|place| place + round).collect();
            client.write_multiple_registers(3, &values).await.unwrap().unwrap();
            assert_eq!(client.read_holding_registers(3, 87).await.unwrap().unwrap(), values);
            client.write_single_register(1000, round).await.unwrap().unwrap();
            assert_eq!(client.read_holding_registers(1000, 1).await.unwrap().unwrap(), [round]);
        }
    });
}

#[test]
fn a_udint_is_two_registers_and_written_by_halves_too() {
    Bench::with(nothing).run(async |bench| {
        let mut client = bench.client(1).await;
        client.write_multiple_registers(2000, &[0x5678, 0x1234, 7, 0]).await.unwrap().unwrap();
        assert_eq!(bench.c_to_m("N1_UDINT_01_C_to_M").await, 0x1234_5678_u32.to_le_bytes());
        client.write_single_register(2001, 0xABCD).await.unwrap().unwrap();
        assert_eq!(bench.c_to_m("N1_UDINT_01_C_to_M").await, 0xABCD_5678_u32.to_le_bytes());
        client.masked_write_register(2000, 0xFF00, 0x0042).await.unwrap().unwrap();
        assert_eq!(bench.c_to_m("N1_UDINT_01_C_to_M").await, 0xABCD_5642_u32.to_le_bytes());
        let read = client.read_write_multiple_registers(2000, 4, 2002, &[9, 8]).await.unwrap().unwrap();
        assert_eq!(read, [0x5642, 0xABCD, 9, 8]);
    });
}

#[test]
fn the_data_of_the_master_and_the_statuses_are_read() {
    Bench::with(nothing).run(async |bench| {
        bench.send(|header, image| {
            header.io_data_active = true;
            header.status |= 0b010;
            image[2..4].copy_from_slice(&0x1234_u16.to_le_bytes());
            *image.last_mut().unwrap() = 0xEE;
        });
        let mut client = bench.client(1).await;
        assert_eq!(client.read_input_registers(1, 1).await.unwrap().unwrap(), [0x1234]);
        assert_eq!(client.read_input_registers(2002, 2).await.unwrap().unwrap(), [0, 0xEE00]);
        let bits = client.read_discrete_inputs(0, 18).await.unwrap().unwrap();
        assert!(bits[1] && bits[16] && !bits[17]);
        let status = client.read_input_registers(3000, 1).await.unwrap().unwrap();
        assert_eq!(status[0] >> 1 & 1, 1);
        let table = client.read_discrete_inputs(100, 33).await.unwrap().unwrap();
        assert!(table[0], "the NX Bus Function Module itself");
    });
}

#[test]
fn forced_values_survive_the_user_program_and_others_do_not() {
    Bench::with(Echo).run(async |bench| {
        bench.send(|header, image| {
            header.io_data_active = true;
            header.status |= 0b110;
            image[..30].fill(1);
        });
        let mut client = bench.client(1).await;
        client.write_single_register(0, 500).await.unwrap().unwrap();
        client.write_single_register(10_001, 501).await.unwrap().unwrap();
        bench.cycles(3).await;
        assert_eq!(client.read_holding_registers(0, 3).await.unwrap().unwrap(), [0x0101, 501, 0x0101]);
        assert_eq!(client.read_coils(10_000, 3).await.unwrap().unwrap(), [false, true, false]);

        // The program copies the forced input.
        client.write_multiple_registers(20_002, &[77]).await.unwrap().unwrap();
        bench.cycles(2).await;
        assert_eq!(client.read_holding_registers(2, 1).await.unwrap().unwrap(), [77]);

        client.write_multiple_coils(10_001, &[false, true]).await.unwrap().unwrap();
        client.write_single_coil(20_002, false).await.unwrap().unwrap();
        bench.cycles(3).await;
        let values = client.read_holding_registers(0, 3).await.unwrap().unwrap();
        assert_eq!(values, [0x0101, 0x0101, 77], "forced as it was");
        assert_eq!(client.read_input_registers(2, 1).await.unwrap().unwrap(), [0x0101]);
    });
}

#[test]
fn what_is_not_in_the_map_is_refused_by_exception_2() {
    const REFUSED: Result<Vec<u16>, ExceptionCode> = Err(ExceptionCode::IllegalDataAddress);
    Bench::with(nothing).run(async |bench| {
        let mut client = bench.client(1).await;
        // Six entries UINTs, one BYTES, two UDINT are allocated.
        for (first, quantity) in [(90, 1), (89, 2), (600, 1), (1010, 1), (2004, 1), (9_999, 1), (u16::MAX, 2)]
        {
            assert_eq!(client.read_input_registers(first, quantity).await.unwrap(), REFUSED);
            assert_eq!(client.read_holding_registers(first, quantity).await.unwrap(), REFUSED);
        }
        assert_eq!(client.read_holding_registers(3000, 1).await.unwrap(), REFUSED);
        let values = [1; 2];
        let refused = Err(ExceptionCode::IllegalDataAddress);
        assert_eq!(client.write_multiple_registers(89, &values).await.unwrap(), refused);
        assert_eq!(client.write_single_coil(0, true).await.unwrap(), refused);
        assert_eq!(client.read_holding_registers(89, 1).await.unwrap().unwrap(), [0], "nothing by halves");
        let both = client.read_write_multiple_registers(90, 1, 0, &[1]).await.unwrap();
        assert_eq!((both, client.read_holding_registers(0, 1).await.unwrap().unwrap()), (REFUSED, vec![0]));
    });
}

#[test]
fn a_byte_takes_no_more_than_255() {
    Bench::with(nothing).run(async |bench| {
        let mut client = bench.client(1).await;
        let refused = client.write_multiple_registers(1000, &[255, 256]).await.unwrap();
        assert_eq!(refused, Err(ExceptionCode::IllegalDataValue));
        assert_eq!(client.read_holding_registers(1000, 2).await.unwrap().unwrap(), [0, 0]);
    });
}

#[test]
fn the_unit_identifier_is_the_position_in_the_line() {
    Bench::with(counts).run(async |bench| {
        for (identifier, expected) in [(0, true), (1, true), (255, true), (2, false), (247, false)] {
            let mut client = bench.client(identifier).await;
            let read = client.read_holding_registers(1, 1).await.unwrap();
            let absent = Err(ExceptionCode::GatewayTargetDevice);
            assert_eq!(read, if expected { Ok(vec![0]) } else { absent }, "{identifier}");
        }
    });
}

#[test]
fn an_image_that_is_read_is_of_one_task_period() {
    // The program fills an entry with the number of the scan.
    let mut scan = 0_u16;
    let fills = move |io: &mut Io| {
        scan = scan.wrapping_add(1);
        (1..=6).for_each(|entry| assert!(io.set_uints(entry, [scan; 15])));
    };
    Bench::with(fills).run(async |bench| {
        let mut client = bench.client(1).await;
        for _ in 0..500 {
            let values = client.read_holding_registers(0, 90).await.unwrap().unwrap();
            assert!(values.iter().all(|value| *value == values[0]), "torn: {values:?}");
        }
    });
}

#[test]
fn what_a_cpu_unit_does_not_take_is_told() {
    Bench::with(nothing).run(async |bench| {
        let mut client = bench.client(1).await;
        client.write_single_register(0, 1).await.unwrap().unwrap();
        bench.stop_cpu();
        let late = client.write_single_register(0, 2).await.unwrap();
        assert_eq!(late, Err(ExceptionCode::Acknowledge), "taken, and not made yet");
        assert_eq!(client.read_holding_registers(0, 1).await.unwrap().unwrap(), [1]);
        bench.remove_cpu();
        let gone = client.write_single_register(0, 3).await.unwrap();
        assert_eq!(gone, Err(ExceptionCode::ServerDeviceFailure));
    });
}
