//! The control channel beside an ethercrab master in OP: the master sees what clients order.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod patient_master;

use std::collections::VecDeque;
use std::fs;
use std::io::{self, Read, Write};
use std::os::unix::net::UnixStream;
use std::path::PathBuf;
use std::time::Duration;

use ectwin::control::{Publisher, Server, Socket, serve};
use ectwin::happenings::KINDS;
use ectwin::{Happenings, Io, Live, Setup, Twin};
use ethercrab::subdevice_group::{Op, SubDeviceGroup};
use ethercrab::{DefaultLock, MainDevice};
use serde_json::{Value, json};
use tokio::time::{Interval, interval};

const UNIT: &str = "model = \"nx-ect101\"\nname = \"N1\"";
/// The start of the data of 0x1A01 in the inputs: after the status in 0x1A00.
const STATUS_BYTES: usize = 2;
/// Only a failure waits for all of them.
const CYCLES_MAX: usize = 20_000;

type Group = SubDeviceGroup<2, 512, DefaultLock, Op>;

/// A master in OP, the unit behind it, and a client of the unit's control channel.
struct Bench {
    _server: Server,
    publisher: Publisher,
    happenings: Happenings,
    _live: Live,
    master: MainDevice<'static>,
    group: Group,
    ticks: Interval,
    client: UnixStream,
    received: Vec<u8>,
    /// Those that came before an answer, and that no test has looked at.
    records: VecDeque<Value>,
    folder: PathBuf,
}

impl Bench {
    async fn in_op(test: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("ectwin-control-{}-{test}", std::process::id()));
        fs::create_dir(&folder).unwrap();
        let (tx, rx, pdu_loop) = patient_master::frames();
        let setup = Setup::from_toml(UNIT).unwrap().program(|_: &mut Io| {}).fast();
        let mut twin = Twin::power_on([setup]);
        let happenings = twin.observe();
        let live = twin.serve_ethercrab(tx, rx).unwrap();
        let socket = Socket::bind(&folder.join("twin.sock")).unwrap();
        let kinds = KINDS.iter().map(|kind| kind.name);
        let (server, publisher) = serve(socket, live.handle().steered("memory"), kinds).unwrap();
        let client = UnixStream::connect(server.path()).unwrap();
        client.set_nonblocking(true).unwrap();

        let master = patient_master::master(pdu_loop, 10);
        let group = master.init_single_group::<2, 512>(|| 0).await.unwrap();
        let group = patient_master::into_op(group, &master).await;
        let (ticks, received) = (interval(Duration::from_millis(1)), Vec::new());
        Self {
            _server: server,
            publisher,
            happenings,
            _live: live,
            master,
            group,
            ticks,
            client,
            received,
            records: VecDeque::new(),
            folder,
        }
    }

    /// One cycle of the master; its working counter.
    async fn cycle(&mut self) -> u16 {
        let response = self.group.tx_rx(&self.master).await.unwrap();
        let records = self.happenings.take();
        self.publisher.publish(records.iter().map(|record| (record.kind, record.json())));
        self.ticks.tick().await;
        response.working_counter
    }

    /// The next line; the master continues meanwhile.
    async fn line(&mut self) -> Value {
        for _ in 0..CYCLES_MAX {
            let mut piece = [0; 4096];
            match self.client.read(&mut piece) {
                Ok(length_bytes) => self.received.extend(&piece[..length_bytes]),
                Err(error) => assert_eq!(error.kind(), io::ErrorKind::WouldBlock),
            }
            if let Some(end) = self.received.iter().position(|byte| *byte == b'\n') {
                let line: Vec<u8> = self.received.drain(..=end).collect();
                return serde_json::from_slice(&line).unwrap();
            }
            self.cycle().await;
        }
        panic!("no line in {CYCLES_MAX} cycles");
    }

    /// The answer. Records come between, those of the start also, which the server may not have handed out yet: they are
    /// kept.
    async fn answer(&mut self, request: Value) -> Value {
        self.client.write_all(format!("{request}\n").as_bytes()).unwrap();
        loop {
            let line = self.line().await;
            if line.get("kind").is_none() {
                return line;
            }
            self.records.push_back(line);
        }
    }

    /// The record of unit 1 that leaves a state.
    async fn leaves(&mut self, state: &str) -> Value {
        loop {
            let line = match self.records.pop_front() {
                Some(record) => record,
                None => self.line().await,
            };
            if line["kind"] == "state" && line["from"] == state {
                return line;
            }
        }
    }

    async fn orders(&mut self, order: &str) {
        let answer = self.answer(json!({ "id": order, "do": order })).await;
        assert_eq!((&answer["id"], &answer["ok"]), (&json!(order), &json!(true)), "{answer}");
    }

    /// Cycles until the master sees this working counter and this first input.
    async fn sees(&mut self, working_counter: u16, input: u16) {
        for _ in 0..CYCLES_MAX {
            let counter = self.cycle().await;
            let inputs = self.group.subdevice(&self.master, 0).unwrap().inputs_raw().to_vec();
            if counter == working_counter && inputs[STATUS_BYTES..][..2] == input.to_le_bytes() {
                return;
            }
        }
        panic!("the master does not see {input} with working counter {working_counter}");
    }
}

impl Drop for Bench {
    fn drop(&mut self) {
        let _gone = fs::remove_dir_all(&self.folder);
    }
}

#[tokio::test]
async fn the_master_sees_forced_and_written_variables() {
    let mut bench = Bench::in_op("variables").await;
    assert_eq!(bench.answer(json!({ "expect": "unit 1 is in OP" })).await["held"], true);
    let forced = bench.answer(json!({ "force": { "N1_UINTs_01_C_to_M[0]": 0x1234 } })).await;
    assert_eq!(forced["values"]["N1_UINTs_01_C_to_M[0]"]["forced"], true, "{forced}");
    bench.sees(3, 0x1234).await;

    bench.orders("write N1_UINTs_01_C_to_M[0] as 7").await;
    let read = bench.answer(json!({ "read": ["N1_UINTs_01_C_to_M[0]"] })).await;
    assert_eq!(read["values"]["N1_UINTs_01_C_to_M[0]"]["value"], 0x1234, "a forced value stays");
    bench.answer(json!({ "release": ["N1_UINTs_01_C_to_M[0]"] })).await;
    let refused =
        bench.answer(json!({ "write": { "N1_UINTs_01_C_to_M[0]": 8, "N1_UINTs_01_C_to_M[99]": 1 } })).await;
    assert_eq!(refused["ok"], false, "{refused}");
    bench.answer(json!({ "write": { "N1_UINTs_01_C_to_M[0]": 8, "N1_UINTs_01_C_to_M[1]": 9 } })).await;
    bench.sees(3, 8).await;
    let read = bench.answer(json!({ "read": ["N1_UINTs_01_C_to_M[0]", "N1_UINTs_01_C_to_M[1]"] })).await;
    assert_eq!(read["values"]["N1_UINTs_01_C_to_M[1]"]["validity"], "valid", "{read}");
}

#[tokio::test]
async fn the_master_sees_faults_of_frames_and_a_restart_and_the_client_what_they_bring() {
    let mut bench = Bench::in_op("faults").await;
    let subscribed = bench.answer(json!({ "subscribe": ["state"] })).await;
    assert_eq!(subscribed["subscribed"], json!(["state"]), "{subscribed}");
    bench.orders("lower the working counter of all process data frames called low").await;
    bench.sees(2, 0).await;
    let faults = bench.answer(json!({ "faults": true })).await;
    assert_eq!(faults["faults"][0]["clear"], "low", "{faults}");
    assert!(faults["faults"][0]["frames_met"].as_u64().unwrap() > 0, "{faults}");
    let cleared = bench.answer(json!({ "clear": "low" })).await;
    assert_eq!(cleared["faults"], json!([]), "{cleared}");
    bench.sees(3, 0).await;

    bench.orders("restart unit 1").await;
    assert_eq!(bench.leaves("OP").await["to"], "INIT");
    bench.sees(0, 0).await;
    let status = bench.answer(json!({ "status": true })).await;
    let unit = &status["units"][0];
    assert_eq!(
        (&unit["state"], &unit["link"]["IN"], &status["link"]),
        (&json!("INIT"), &json!(true), &json!("memory"))
    );
}

#[tokio::test]
async fn faults_of_units_are_listed_and_cleared_and_modes_are_shown() {
    let mut bench = Bench::in_op("modes").await;
    bench.orders("set unit 1 to PROGRAM mode").await;
    let status = bench.answer(json!({ "status": true })).await;
    assert_eq!(status["units"][0]["mode"], "PROGRAM", "{status}");
    bench.orders("break Processing of unit 1").await;
    let waited = bench
        .answer(json!({ "expect": "unit 1 is in INIT with AL status code 0x0001", "within": "30s" }))
        .await;
    assert_eq!(waited["held"], true, "{waited}");
    let status = bench.answer(json!({ "status": true })).await;
    let unit = &status["units"][0];
    assert_eq!((&unit["al_status_code"], &unit["error"]), (&json!("0x0001"), &json!(true)), "{unit}");
    assert_eq!(unit["errors"][0]["event"], "40200000", "{unit}");
    let refused = bench.answer(json!({ "clear": "Procesing of unit 1" })).await;
    assert_eq!(refused["error"]["nearest"], json!(["Processing of unit 1"]), "{refused}");
    assert_eq!(bench.answer(json!({ "clear": "all" })).await["faults"], json!([]));
}

#[tokio::test]
async fn every_sentence_that_is_listed_is_one_for_this_line() {
    let mut bench = Bench::in_op("sentences").await;
    let sentences = bench.answer(json!({ "sentences": true })).await;
    let rows = sentences["sentences"].as_array().unwrap();
    let examples = |about: &str| rows.iter().filter(|row| row["about"] == about).count();
    assert!(
        examples("unit") > 20 && examples("cpu") > 15 && examples("line") > 10 && examples("condition") > 30
    );
    for row in rows.iter().filter(|row| row["verb"] == "expect") {
        let answer = bench.answer(json!({ "expect": row["example"] })).await;
        let message = answer["error"]["message"].as_str().unwrap_or_default();
        assert!(
            !message.contains("scripted master") && !message.contains("is not a valid sentence"),
            "{answer}"
        );
    }
    let object = bench.answer(json!({ "object": "N1 1018:01" })).await;
    assert_eq!((&object["value"], &object["type"]), (&json!(0x83), &json!("U32")), "{object}");
}
