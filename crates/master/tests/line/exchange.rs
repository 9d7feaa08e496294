//! Process data of all slaves in shared frames.

use crate::bench::{Slaves, connected, connected_with, terminals};
use digital::{BitImages, Terminal};
use master::{Commands, Connected, Grouping, Habits, Line, Master, StatusRead};
use time::Duration;
use wire::{AlState, Command, datagrams};

const CYCLE: Duration = Duration::from_millis(1);

fn habits(commands: Commands, status: StatusRead) -> Master {
    let mut habits = Habits { listen_period: None, ..Habits::default() };
    (habits.exchange.commands, habits.exchange.status) = (commands, status);
    Master::new(habits)
}

/// Frames of one cycle: command and data length of each datagram.
fn cycle<U: device::Unit>(bench: &mut Connected<Slaves<U>>) -> Vec<Vec<(Command, usize)>> {
    // After the frames of the present time.
    bench.run_for(Duration::from_micros(1));
    bench.line.frames.clear();
    bench.run_for(CYCLE);
    let of = |frame: &Vec<u8>| {
        datagrams(frame).map(|datagram| (datagram.header.command, datagram.data.len())).collect()
    };
    bench.line.frames.iter().map(of).collect()
}

#[test]
fn terminals_share_one_datagram_and_bytes_of_it() {
    let mut bench =
        terminals(habits(Commands::Lrw, StatusRead::Never), &[(4, 0), (4, 0), (0, 4), (0, 4), (2, 12)]);
    bench.search().expect("five terminals");
    bench.take_all_to(AlState::Op).expect("OP");
    // Outputs 4 + 4 + 2 bits, inputs 4 + 4 bits and 12 in two separate bytes.
    assert_eq!(cycle(&mut bench), [[(Command::Lrw, 2 + 1 + 2)]]);
    let set = |bench: &mut Connected<Slaves<Terminal<BitImages>>>, position: usize, value| {
        bench.line.network.device_mut(position).expect("a terminal").unit_mut().wiring_mut().inputs = value;
    };
    for (position, value) in [(2, 0x0A), (3, 0x05), (4, 0xAC3)] {
        set(&mut bench, position, value);
    }
    for (position, value) in [(0, 0x09), (1, 0x06), (4, 0x02)] {
        bench.master.outputs_mut(position)[0] = value;
    }
    bench.run_for(CYCLE * 4);
    let outputs = |position| {
        let terminal = bench.line.network.device_mut(position).expect("a terminal").unit_mut();
        terminal.wiring_mut().outputs
    };
    assert_eq!([0, 1, 4].map(outputs), [0x09, 0x06, 0x02]);
    assert_eq!([2, 3].map(|position| bench.master.inputs(position)[0]), [0x0A, 0x05]);
    assert_eq!(bench.master.inputs(4), [0xC3, 0x0A]);
    let report = bench.master.cycle();
    assert_eq!((report.working_counter, report.expected, report.lost), (2 + 2 + 1 + 1 + 3, 9, 0));
}

/// 25 units of 180 and 183 bytes: 9,075 bytes in seven frames; one frame for each unit would need 25.
#[test]
fn frames_are_filled_and_no_process_data_are_torn() {
    let mut bench = connected_with(habits(Commands::Lrw, StatusRead::Never), 25, |_, _| {});
    bench.search().expect("25 units");
    bench.take_all_to(AlState::Op).expect("OP");
    let frames = cycle(&mut bench);
    // Eight areas fit into 1,486 bytes, and none is split.
    assert_eq!(frames.len(), 7);
    assert!(frames.iter().all(|frame| frame.len() == 1 && frame[0].1 <= 1_486));
    let total: usize = frames.iter().map(|frame| frame[0].1).sum();
    assert_eq!(total, 25 * (180 + 183));
    let report = bench.master.cycle();
    assert_eq!((report.working_counter, report.expected), (75, 75));
}

#[test]
fn each_slave_may_have_a_datagram_of_its_own_in_frames_that_are_shared() {
    let mut habits = Habits { listen_period: None, ..Habits::default() };
    (habits.exchange.grouping, habits.exchange.commands) = (Grouping::EachSlave, Commands::Fitting);
    let mut bench = connected_with(Master::new(habits), 9, |_, _| {});
    bench.search().expect("nine units");
    bench.take_all_to(AlState::Op).expect("OP");
    // 1,498 bytes hold three datagrams of 375.
    assert_eq!(cycle(&mut bench), vec![vec![(Command::Lrw, 180 + 183); 3]; 3]);
    bench.line.network.power_off(4, bench.now());
    bench.run_for(CYCLE);
    let counters: Vec<_> = (0..9).map(|slave| bench.master.working_counter(slave)).collect();
    let expected = [3, 3, 3, 3, 0, 0, 0, 0, 0].map(Some);
    assert_eq!(counters, expected, "behind a slave without power nobody is reached");
}

#[test]
fn commands_are_a_matter_of_choice() {
    let bits = [(8, 8), (8, 8)];
    for (commands, expected, counter) in [
        (Commands::Lrw, vec![(Command::Lrw, 4)], 6),
        (Commands::Fitting, vec![(Command::Lrw, 4)], 6),
        (Commands::Separate, vec![(Command::Lwr, 2), (Command::Lrd, 2)], 4),
    ] {
        let mut bench = terminals(habits(commands, StatusRead::Never), &bits);
        bench.search().expect("two terminals");
        bench.take_all_to(AlState::Op).expect("OP");
        assert_eq!(cycle(&mut bench), [expected]);
        let report = bench.master.cycle();
        assert_eq!((report.working_counter, report.expected), (counter, counter));
    }
    let mut bench = terminals(habits(Commands::Fitting, StatusRead::Never), &[(8, 0)]);
    bench.search().expect("a terminal");
    bench.take_all_to(AlState::Op).expect("OP");
    assert_eq!(cycle(&mut bench), [[(Command::Lwr, 1)]]);
}

#[test]
fn al_status_is_read_in_the_same_frame() {
    for (status, datagrams) in [
        (StatusRead::Broadcast, vec![(Command::Lrw, 4), (Command::Brd, 2)]),
        (StatusRead::EachSlave, vec![(Command::Lrw, 4), (Command::Fprd, 2), (Command::Fprd, 2)]),
    ] {
        let mut bench = terminals(habits(Commands::Lrw, status), &[(8, 8), (8, 8)]);
        bench.search().expect("two terminals");
        bench.take_all_to(AlState::Op).expect("OP");
        assert_eq!(cycle(&mut bench), [datagrams]);
        if status == StatusRead::Broadcast {
            let (slaves, al_status) = bench.master.cycle().status.expect("a status");
            assert_eq!((slaves, al_status.state, al_status.error), (2, AlState::Op, false));
        }
        bench.line.network.power_off(1, bench.now());
        bench.run_for(CYCLE);
        let report = bench.master.cycle();
        assert_eq!((report.working_counter, report.expected), (3, 6), "one slave is gone");
        if status == StatusRead::Broadcast {
            assert_eq!(report.status.map(|(slaves, _)| slaves), Some(1));
        }
    }
}

#[test]
fn what_a_slave_shows_is_seen_with_each_cycle() {
    let mut bench = terminals(habits(Commands::Lrw, StatusRead::EachSlave), &[(8, 8), (0, 8)]);
    bench.search().expect("two terminals");
    bench.take_all_to(AlState::Op).expect("OP");
    let frame = |bench: &mut Connected<Slaves<Terminal<BitImages>>>| {
        let request = bench.master.datagram(Command::Apwr, 0, 0x0120, &[5, 0]);
        bench.complete(request);
        bench.run_for(CYCLE * 2);
    };
    frame(&mut bench);
    let states = bench.master.slaves().iter().map(|slave| (slave.state(), slave.al_report().status.error));
    assert_eq!(states.collect::<Vec<_>>(), [(AlState::SafeOp, true), (AlState::Op, false)]);
}

#[test]
fn a_slave_whose_process_data_change_goes_behind_those_that_exchange() {
    let mut bench = connected(2);
    bench.search().expect("two units");
    bench.take_all_to(AlState::Op).expect("OP");
    bench.take_to(0, AlState::PreOp).expect("PRE-OP");
    assert_eq!(bench.master.cycle().expected, 3, "the other one still exchanges");
    let settings = bench.master.settings_mut(0).expect("a slave");
    let [outputs, inputs] = [0, 1].map(|at| settings.process_data[at].bits);
    // Without its outputs: 1C12 has no PDO.
    let number = settings.process_data[0].sync_manager.number;
    settings.set_bits(number, 0);
    settings.start_up = vec![master::StartUpSdo {
        transition: esi::Transition::Ps,
        target: wire::SdoTarget::entry(0x1C12, 0),
        data: vec![0],
    }];
    bench.take_to(0, AlState::Op).expect("OP");
    bench.run_for(CYCLE * 2);
    assert_eq!((bench.master.outputs(0).len(), bench.master.inputs(0).len()), (0, inputs as usize / 8));
    assert_eq!(bench.master.outputs(1).len(), outputs as usize / 8);
    let report = bench.master.cycle();
    assert_eq!((report.working_counter, report.expected), (1 + 3, 4));
}

#[test]
fn a_slave_on_its_way_keeps_the_place_for_which_its_fmmus_are_set() {
    let mut bench = terminals(habits(Commands::Lrw, StatusRead::Never), &[(16, 0), (8, 0)]);
    bench.search().expect("two terminals");
    bench.take_all_to(AlState::PreOp).expect("PRE-OP");
    let set_bits = |bench: &mut Connected<Slaves<_>>, bits| {
        let settings = bench.master.settings_mut(0).expect("a slave");
        settings.set_bits(settings.process_data[0].sync_manager.number, bits);
    };
    set_bits(&mut bench, 0);
    let now = bench.now();
    let second = bench.master.take_to(now, 1, AlState::SafeOp);
    let mut frame = Vec::new();
    while !datagrams(&frame).any(|datagram| datagram.header.offset == 0x0600) {
        let ticket = bench.master.transmit(now, &mut frame).expect("a frame to the second terminal");
        bench.line.frame(now, &mut frame);
        bench.line.poll(now);
        bench.master.receive(now, ticket, &frame);
    }
    set_bits(&mut bench, 16);
    let first = bench.master.take_to(now, 0, AlState::SafeOp);
    bench.complete(second);
    bench.complete(first);
    bench.take_all_to(AlState::Op).expect("OP");
    bench.master.outputs_mut(0).copy_from_slice(&[0x11, 0x22]);
    bench.master.outputs_mut(1).copy_from_slice(&[0x33]);
    bench.run_for(CYCLE * 4);
    let outputs = |position| {
        let terminal = bench.line.network.device_mut(position).expect("a terminal").unit_mut();
        terminal.wiring_mut().outputs
    };
    assert_eq!([0, 1].map(outputs), [0x2211, 0x33]);
}

#[test]
fn a_period_of_no_length_is_a_very_short_one() {
    let mut bench = terminals(habits(Commands::Lrw, StatusRead::Never), &[(8, 8)]);
    bench.search().expect("a terminal");
    bench.take_all_to(AlState::Op).expect("OP");
    bench.master.exchange(bench.now(), Duration::ZERO);
    let before = bench.master.cycle().cycles;
    bench.run_for(Duration::from_nanos(10));
    assert_eq!(bench.master.cycle().cycles - before, 11);
}

#[test]
fn the_period_is_kept_and_may_change() {
    let mut bench = terminals(habits(Commands::Lrw, StatusRead::Never), &[(8, 8)]);
    bench.search().expect("a terminal");
    bench.take_all_to(AlState::Op).expect("OP");
    let before = bench.master.cycle().cycles;
    bench.run_for(CYCLE * 100);
    assert_eq!(bench.master.cycle().cycles - before, 100);
    bench.master.exchange(bench.now(), CYCLE * 5);
    let before = bench.master.cycle().cycles;
    bench.run_for(CYCLE * 100);
    // One immediately, then one every 5 ms.
    assert_eq!(bench.master.cycle().cycles - before, 21);
}
