//! Messages between a master and a user program by NX objects, in both directions at once (manual, A-5).

use core::task::Poll;
use std::sync::mpsc::{Receiver, Sender, channel};

use nx_ect101::IoAllocation;
use plc::{
    CpuSettings, DeviceVariables, Io, NxCall, NxMessageError, ObjectIndex, Program, StructuredText, SubIndex,
};
use time::Duration;

use crate::bench::{Bench, Random, SAFE_OP};

const MESSAGES: u32 = 10_000;
const NOT_READY: u32 = 0x0800_0021;
const MESSAGE: SubIndex = SubIndex(1);

/// Bits of CoE 6003 in the first byte of the inputs.
const NX_MESSAGES_ENABLED: u8 = 1 << 0;
const NEW_MESSAGE: u8 = 1 << 3;
const READY_TO_WRITE: u8 = 1 << 4;

/// Message `number` of one direction: every byte depends on the number and on its position.
fn message(number: u32, salt: u8) -> Vec<u8> {
    let body = (4..200_u32).map(|place| (number.wrapping_mul(31).wrapping_add(place * 7)) as u8 ^ salt);
    number.to_le_bytes().into_iter().chain(body).collect()
}

const TO_CPU: u8 = 0x00;
const TO_MASTER: u8 = 0xA5;

/// The reports of the user program to the test.
enum Told {
    Received(Vec<u8>),
    Refused,
}

/// Receives messages, and sends numbered messages, sometimes before the master has read the last one.
struct Talker {
    random: Random,
    reading: Option<NxCall>,
    writing: Option<NxCall>,
    next: u32,
    tell: Sender<Told>,
}

impl Program for Talker {
    fn scan(&mut self, io: &mut Io) {
        let status = io.status();
        if !status.sdo_enabled {
            return;
        }
        self.take_results(io);
        // The program is sometimes slow, so that the master also comes too early.
        if self.reading.is_none() && status.new_message && self.random.below(4) == 0 {
            self.reading = io.nx_objects().read(ObjectIndex(0x5000), MESSAGE).ok();
        }
        let too_early = self.random.below(50) == 0;
        if self.writing.is_none() && self.next < MESSAGES && (status.ready_to_write_message || too_early) {
            let value = message(self.next, TO_MASTER);
            self.writing = io.nx_objects().write(ObjectIndex(0x5001), MESSAGE, &value).ok();
        }
    }
}

impl Talker {
    fn take_results(&mut self, io: &mut Io) {
        let client = io.nx_objects();
        if let Some(Poll::Ready(result)) = self.reading.map(|call| client.take(call)) {
            self.reading = None;
            let value = result.expect("5000:01 can be read");
            self.tell(Told::Received(value.to_vec()));
        }
        if let Some(Poll::Ready(result)) = self.writing.map(|call| client.take(call)) {
            self.writing = None;
            match result {
                Ok(_) => self.next += 1,
                Err(NxMessageError::NotReady) => self.tell(Told::Refused),
                Err(error) => panic!("5001:01: {error}"),
            }
        }
    }

    fn tell(&self, told: Told) {
        self.tell.send(told).expect("the test listens");
    }
}

fn start() -> (Bench, Receiver<Told>) {
    let (tell, told) = channel();
    let talker = Talker { random: Random(3), reading: None, writing: None, next: 0, tell };
    let mut bench =
        Bench::with_program(IoAllocation::factory(), CpuSettings::default(), talker).into_pre_op();
    bench.set_process_data(180, 183);
    assert_eq!(bench.request(SAFE_OP), (SAFE_OP, 0));
    (bench, told)
}

/// The first byte of NX Unit Status.
fn status(bench: &mut Bench) -> u8 {
    bench.read(nx_ect101::layout::INPUTS_START, 183)[0]
}

#[test]
fn ten_thousand_messages_each_way_are_neither_lost_nor_doubled() {
    let (mut bench, told) = start();
    let mut random = Random(4);
    let (mut sent, mut refused, mut received) = (0, 0, Vec::new());
    let (mut received_by_cpu, mut refused_to_cpu) = (Vec::new(), 0);
    while received_by_cpu.len() < MESSAGES as usize || received.len() < MESSAGES as usize {
        let flags = status(&mut bench);
        let too_early = random.below(4) == 0;
        if sent < MESSAGES && (flags & READY_TO_WRITE != 0 || too_early) {
            match bench.download(0x3001, 1, &message(sent, TO_CPU)) {
                Ok(()) => sent += 1,
                Err(code) => {
                    assert_eq!(code, NOT_READY);
                    refused += 1;
                }
            }
        }
        if status(&mut bench) & NEW_MESSAGE != 0 {
            received.push(bench.upload(0x3000, 1).expect("readable"));
        }
        for told in told.try_iter() {
            match told {
                Told::Received(message) => received_by_cpu.push(message),
                Told::Refused => refused_to_cpu += 1,
            }
        }
    }
    let all = |salt| (0..MESSAGES).map(|number| message(number, salt)).collect::<Vec<_>>();
    assert!(received_by_cpu == all(TO_CPU), "master to CPU Unit");
    assert!(received == all(TO_MASTER), "CPU Unit to master");
    assert!(refused > 100 && refused_to_cpu > 100, "refused: {refused}, {refused_to_cpu}");
}

#[test]
fn a_write_while_not_ready_is_refused_and_the_first_message_stays() {
    let program = |_: &mut Io| {};
    let mut bench =
        Bench::with_program(IoAllocation::factory(), CpuSettings::default(), program).into_pre_op();
    bench.set_process_data(180, 183);
    assert_eq!(bench.request(SAFE_OP), (SAFE_OP, 0));
    // A unit refreshes before it answers, so the following messages are in order.
    bench.access.run_for(Duration::from_millis(2));
    assert_eq!(status(&mut bench) & READY_TO_WRITE, READY_TO_WRITE);
    assert_eq!(status(&mut bench) & NX_MESSAGES_ENABLED, NX_MESSAGES_ENABLED);
    bench.download(0x3001, 1, &message(1, TO_CPU)).expect("ready");
    assert_eq!(status(&mut bench) & READY_TO_WRITE, 0, "no flag is older than the response");
    assert_eq!(bench.download(0x3001, 1, &message(2, TO_CPU)), Err(NOT_READY));
    assert_eq!(bench.upload(0x3001, 1), Ok(message(1, TO_CPU)));
    assert_eq!(bench.upload(0x3000, 1), Ok(vec![0; 200]), "nothing has come from the CPU Unit");
}

#[test]
fn a_message_has_200_bytes() {
    let (mut bench, _told) = start();
    assert_eq!(bench.download(0x3001, 1, &[1; 199]), Err(0x0607_0010));
    assert_eq!(bench.download(0x3001, 1, &[1; 201]), Err(0x0607_0010));
    assert_eq!(bench.download(0x3000, 1, &[1; 200]), Err(0x0601_0002));
}

/// Reads the serial number again and again, with a time-out of 0.1 s. The same for a write of a message.
const AGAIN_AND_AGAIN: &str = "
    VAR
        Read : NX_ReadObj; Write : NX_WriteObj;
        Serial_Number : _sNXOBJ_ACCESS := (Index := 16#1000, Subindex := 7);
        To_Master : _sNXOBJ_ACCESS := (Index := 16#5001, Subindex := 1);
        Serial : UDINT; Message : ARRAY[0..199] OF BYTE;
        Late, Served, Refused : UDINT;
    END_VAR
    Read(Execute := NOT (Read.Done OR Read.Error), UnitProxy := N1_Node_location_information, Obj := Serial_Number,
        TimeOut := 1, ReadDat := Serial);
    Write(Execute := NOT (Write.Done OR Write.Error), UnitProxy := N1_Node_location_information, Obj := To_Master,
        TimeOut := 1, WriteDat := Message);
    IF Read.Done THEN Served := Served + 1; END_IF;
    IF Read.ErrorID = 16#2C02 THEN Late := Late + 1; END_IF;
    IF Read.ErrorID = 16#2C01 OR Write.ErrorID = 16#2C01 THEN Refused := Refused + 1; END_IF;";

#[test]
fn calls_that_timed_out_leave_room_for_the_next_ones() {
    let allocation = IoAllocation::factory();
    let variables = DeviceVariables::of(nx_ect101::variable_table("N1", 1, &allocation));
    let program = StructuredText::compile(AGAIN_AND_AGAIN, &variables).expect("a program");
    let mut bench = Bench::with_program(allocation, CpuSettings::default(), program);
    let count = |bench: &Bench, name: &str| {
        let text = bench.access.line.cpu.program_variable(name).expect("declared");
        text.parse::<u32>().expect("a number")
    };
    bench.access.run_for(Duration::from_millis(100));
    assert!(count(&bench, "Served") > 10);
    bench.power_off();
    bench.access.run_for(Duration::from_millis(2_000));
    let (late, served) = (count(&bench, "Late"), count(&bench, "Served"));
    assert!(late > 9, "{late}");
    bench.power_on_again();
    bench.access.run_for(Duration::from_millis(1_000));
    assert!(count(&bench, "Served") > served + 100, "{} and {served}", count(&bench, "Served"));
    assert_eq!(count(&bench, "Refused"), 0, "16#2C01, resources exceeded");
}

/// Writes a message when it is asked to, and records the result.
struct OneMessage {
    asked: Receiver<()>,
    writing: Option<NxCall>,
    tell: Sender<Result<(), NxMessageError>>,
}

impl Program for OneMessage {
    fn scan(&mut self, io: &mut Io) {
        let client = io.nx_objects();
        if let Some(Poll::Ready(result)) = self.writing.map(|call| client.take(call)) {
            self.writing = None;
            self.tell.send(result.map(drop)).expect("the test listens");
        }
        if self.asked.try_recv().is_ok() {
            self.writing = client.write(ObjectIndex(0x5001), MESSAGE, &message(1, TO_MASTER)).ok();
        }
    }
}

#[test]
fn a_write_to_a_unit_without_power_is_not_executed_after_power_on() {
    let ((ask, asked), (tell, told)) = (channel(), channel());
    let program = OneMessage { asked, writing: None, tell };
    let mut bench = Bench::with_program(IoAllocation::factory(), CpuSettings::default(), program);
    bench.access.run_for(Duration::from_millis(10));
    bench.power_off();
    ask.send(()).expect("the program listens");
    bench.access.run_for(Duration::from_millis(200));
    bench.power_on_again();
    bench.access.run_for(Duration::from_millis(1_000));
    assert_eq!(told.try_iter().collect::<Vec<_>>(), [Err(NxMessageError::NotReachable)]);
    let mut bench = bench.into_pre_op();
    assert_eq!(bench.upload(0x3000, 1), Ok(vec![0; 200]), "no message has come from the CPU Unit");
    // With power the same write is executed.
    ask.send(()).expect("the program listens");
    bench.access.run_for(Duration::from_millis(10));
    assert_eq!(told.try_iter().collect::<Vec<_>>(), [Ok(())]);
    assert_eq!(bench.upload(0x3000, 1), Ok(message(1, TO_MASTER)));
}
